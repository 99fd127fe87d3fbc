#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::config {

/// Where results, catalogue and schedule live.
struct ResultsSettings {
  std::string connection;           ///< libpq connection string of the worker; required
  std::string owner_connection;     ///< of the schema's owner (migrate, maintain, loops, import);
                                    ///< empty = connection
  std::string engineer_connection;  ///< of a member of loopscope_engineer (annotate, maintenance,
                                    ///< pages); empty = owner_connection
  int retention_months = 24;        ///< months of results that maintain keeps, 0 to 1200; 0 = all
};

/// One historian: a connection, and where and how its tables keep the tags. `preset` gives the
/// defaults of a vendor's tables, every other field may change them (HISTORIANS.md).
struct HistorianSettings {
  std::string name = "plant";     ///< what loops refer to as their source
  std::string preset = "narrow";  ///< see historian_presets.hpp
  std::string connection;         ///< libpq connection string of a reader; required
  std::string writer_connection;  ///< only for `import`; empty = connection
  std::string layout = "narrow";  ///< narrow, loop_row, wide
  std::string table = "public.history";
  std::string partition_table;  ///< lists the tables of the data; empty = `table` is the only one
  std::string partition_name_column;
  std::string partition_start_column;
  std::string partition_end_column;
  std::string tag_column = "tag";   ///< of the tag, or of its first part; empty in wide tables
  std::string tag_table;            ///< names of what tag_column holds; empty = it holds the names
  std::string tag_name_column;      ///< of tag_table
  std::string tag_id_column;        ///< of tag_table
  std::string tag_order_column;     ///< of tag_table: puts several ids of a name in order
  bool tag_ignore_case = false;     ///< of the names in tag_table
  std::string subtag_column;        ///< of the second part of a tag; empty = tags have one part
  std::string subtag_table;         ///< names of what subtag_column holds
  std::string subtag_name_column;   ///< of subtag_table
  std::string subtag_id_column;     ///< of subtag_table
  std::string tag_separator = ".";  ///< between the parts of a tag
  std::string time_column = "time";
  /// timestamptz, timestamp_utc, timestamp_local, epoch_s, epoch_s_float, epoch_ms, epoch_us,
  /// epoch_ns
  std::string time_kind = "timestamptz";
  std::string time_zone;                        ///< of timestamp_local
  std::string nanos_column;                     ///< nanoseconds after the full second; empty = none
  std::string value_column = "value";           ///< of narrow tables
  std::vector<std::string> more_value_columns;  ///< asked in turn where value_column is NULL
  std::vector<std::string> states;              ///< "TEXT=NUMBER": what texts mean
  std::string null_means = "bad";               ///< bad, absent
  std::string quality_column = "quality";       ///< empty = none
  /// none, opcda, opcda_exact, opcua, opchda, zero, truth, codes
  std::string quality_rule = "opcda";
  bool accept_uncertain = false;
  std::vector<std::string> good_codes;         ///< of the rule `codes`
  std::vector<std::string> uncertain_codes;    ///< likewise
  std::vector<std::string> bad_codes;          ///< likewise; what is in no list is unknown
  std::string quality_table;                   ///< names of the codes; empty = the lists hold codes
  std::string quality_name_column;             ///< of quality_table
  std::string quality_id_column;               ///< of quality_table
  std::string tiebreak_column;                 ///< of rows with one time the largest counts
  std::string interpolation = "sample";        ///< sample, step, linear
  std::string interpolation_column;            ///< of tag_table: how each tag is archived
  std::vector<std::string> step_codes;         ///< of interpolation_column
  std::vector<std::string> linear_codes;       ///< of interpolation_column
  std::vector<std::string> manual_codes{"0"};  ///< values of a mode tag
  std::vector<std::string> automatic_codes{"1"};  ///< likewise
  std::vector<std::string> cascade_codes{"2"};    ///< likewise
  int max_connections = 4;  ///< of this process at a time, over all workers, 1 to 64

  [[nodiscard]] bool operator==(const HistorianSettings&) const = default;
};

/// When and in what portions the work is done.
struct ScheduleSettings {
  double poll_s = 10.0;              ///< seconds between two polls for due loops, 0.1 to 3600
  double settle_s = 60.0;            ///< nothing newer than this is read, 0 to 86400
  double lease_s = 300.0;            ///< seconds after which others take over, 10 to 86400
  int batch_loops = 32;              ///< loops per claim, 1 to 256
  double default_period_s = 3600.0;  ///< of a loop that is added without one, 1 to 2592000
  int revise_slots = 1;              ///< earlier slots that are checked for late rows, 0 to 48
  /// A window is read whole at every so many slots of a loop, 1 to 1000; between them only what is
  /// new, where the rest is kept in memory (DaemonSettings::cache_mb). 1 = always.
  int whole_read_every = 24;
  int catch_up_slots = 6;     ///< missed slots that are made up for, 0 to 1000
  int model_all_up_to = 500;  ///< enabled loops, 0 to 1000000; see model_every_slots
  /// With more loops than that, a loop that gives no cause gets a loop model in every so many slots
  /// only, 1 to 1000.
  int model_every_slots = 10;

  /// Seconds that a claim holds unless it is extended: a poll less than the lease, because others
  /// may look for what has become free only once in a poll.
  [[nodiscard]] double hold_s() const { return lease_s - poll_s; }
};

/// Who may say something of a finding on the pages (daemon/monitor/README.md, "Acknowledging").
struct AcknowledgeSettings {
  /// Addresses and networks whose requests name a user; empty = nobody writes. See ip_network.hpp.
  std::vector<std::string> trusted_proxies;
  std::string user_header = "X-Remote-User";  ///< in which they name him
  std::string origin;  ///< under which people see the pages; see web_origin.hpp

  [[nodiscard]] bool on() const { return !trusted_proxies.empty(); }
};

/// The process itself.
struct DaemonSettings {
  int workers = 0;                  ///< cores to analyse on; 0 = all; 0 to 256
  int batches_in_flight = 0;        ///< workers; 0 = two a core; 0 to 1024
  int cache_mb = 512;               ///< memory for windows that are not read again; 0 to 1000000
  std::string log_level = "info";   ///< debug, info, warning, error
  std::string log_format = "text";  ///< text or json
  std::string http_address = "127.0.0.1:9470";  ///< see http_address.hpp; empty = no HTTP
  std::vector<std::string> http_names;          ///< it may be called so; see host_name.hpp
  /// Seconds that the most overdue loop may be late before /readyz says no, 1 to 2592000.
  double max_lag_s = 3600.0;
  AcknowledgeSettings acknowledge;

  [[nodiscard]] std::size_t cache_bytes() const {
    return static_cast<std::size_t>(cache_mb) * 1'000'000;
  }
};

/// Which loops are shown as flagged.
struct FlagSettings {
  /// Expected share of loops without a fault on the list, 0 to 0.5: of flagged_loop.
  double list_false_share = 0.03;
  /// A loop stays until this share is exceeded, list_false_share to 0.5.
  double list_leave_share = 0.2;
  /// Of a fault, that a loop enters the list with, at least; 0.5 to 1.
  double list_least_probability = 0.8;
  /// Of a fault, below which a loop leaves the list; 0 to list_least_probability.
  double list_leave_probability = 0.5;
  /// Share of tested flags that may be false, 0.0001 to 1; 1 = the list goes by odds alone.
  double false_discovery_rate = 0.005;
  /// positive: tests of different loops are independent or rise together; arbitrary: in any way
  std::string false_discovery_dependence = "positive";
  double min_confidence = 0.3;  ///< verdicts below are not flagged, 0 to 1
};

/// What is done with all loops together, and where they are.
struct PlantSettings {
  /// In which people read and write times: a name of the IANA database; see time_zones.hpp.
  std::string time_zone = "UTC";
  double round_s = 3600.0;  ///< seconds between two comparisons of all loops, 0 to 604800; 0 = none
  double notice_s = 60.0;   ///< between two looks for newly flagged loops, 0 to 86400; 0 = none
};

/// How `loops discover` groups tags into loops (daemon/catalogue/README.md, "Discovery"). Patterns
/// between semicolons, tried in turn, empty = the program reads names by itself; words between
/// commas, whatever their case, the preferred one first.
struct DiscoverySettings {
  std::string patterns;
  std::string sp_words = "SP,SV,SETPOINT,SPT,SP_WRK,CSP,WSP,SP_OUT";
  std::string pv_words = "PV,MEAS,PROCESS,PROCESSVALUE,PROCESSVARIABLE,MEASUREMENT,PV_IN,PV_OUT";
  std::string op_words =
      "OP,OUT,CO,OUTPUT,CONTROLLEROUTPUT,CONTROLOUTPUT,MANIPULATEDVARIABLE,LMN,CV,MV";
  std::string mv_words = "ZT,POS,POSITION,VP,ZI,FEEDBACK,RBK,MV";
  std::string mode_words = "MODE,MD,AUTO";
};

/// The report that the daemon writes by itself (daemon/report/README.md, "Reports").
struct ReportSettings {
  std::string plant;  ///< name of the plant, for the title; empty = none
  /// Under which people see the daemon's pages (see web_origin.hpp): where a report leads; empty =
  /// that of acknowledging, and without one nowhere.
  std::string pages_origin;
  std::string folder;        ///< where `run` writes reports; empty = it writes none
  double every_s = 86400.0;  ///< seconds between two of them, 60 to 31622400
  bool pdf = false;          ///< whether a PDF is made beside the page
  int keep = 30;             ///< reports that stay in the folder, 1 to 10000
};

/// The whole settings file.
struct Settings {
  ResultsSettings results;
  std::vector<HistorianSettings> historians;
  ScheduleSettings schedule;
  DaemonSettings daemon;
  FlagSettings flags;
  PlantSettings plant;
  DiscoverySettings discovery;
  ReportSettings report;
  core::AnalysisSettings analysis;
};

}  // namespace loopscope::config
