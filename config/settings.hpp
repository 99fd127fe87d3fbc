#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::config {

/// Where results, catalogue and schedule live.
struct ResultsSettings {
  std::string connection;        ///< libpq connection string of the worker; required
  std::string owner_connection;  ///< of the schema's owner (migrate, maintain, loops, import);
                                 ///< empty = connection
  int retention_months = 24;     ///< months of results that maintain keeps, 0 = all
};

/// One historian in the narrow layout (tag, time, value, quality).
struct HistorianSettings {
  std::string name = "plant";     ///< what loops refer to as their source
  std::string connection;         ///< libpq connection string of a reader; required
  std::string writer_connection;  ///< only for `import`; empty = connection
  std::string table = "public.history";
  std::string tag_column = "tag";
  std::string time_column = "time";
  std::string value_column = "value";
  std::string quality_column = "quality";  ///< empty = none
  std::string time_kind =
      "timestamptz";  ///< timestamptz, timestamp_utc, epoch_s, epoch_s_float, epoch_ms, epoch_us
  std::string quality_rule = "opcda";  ///< none, opcda, zero
  int max_connections = 4;             ///< of this process at a time, over all workers, 1 to 64

  [[nodiscard]] bool operator==(const HistorianSettings&) const = default;
};

/// When and in what portions the work is done.
struct ScheduleSettings {
  double poll_s = 10.0;              ///< seconds between two looks for due loops, 0.1 to 3600
  double settle_s = 60.0;            ///< nothing newer than this is read, 0 to 86400
  double lease_s = 300.0;            ///< seconds that a claimed loop is held, 10 to 86400
  int batch_loops = 16;              ///< loops per claim, 1 to 256
  double default_period_s = 3600.0;  ///< analysis period of a loop that is added without one
  int revise_slots = 1;              ///< earlier slots that are checked for late rows, 0 to 48
};

/// The process itself.
struct DaemonSettings {
  int workers = 0;                  ///< threads; 0 = one per core; 0 to 256
  std::string log_level = "info";   ///< debug, info, warning, error
  std::string log_format = "text";  ///< text or json
};

/// Which loops are shown as flagged.
struct FlagSettings {
  double false_discovery_rate = 0.05;  ///< share of tested flags that may be false, 0.0001 to 0.5
  /// positive: tests of different loops are independent or rise together; arbitrary: in any way
  std::string false_discovery_dependence = "positive";
  double min_confidence = 0.3;  ///< verdicts below are not flagged, 0 to 1
};

/// How `loops discover` groups tags into loops (daemon/README.md, "Discovery"). Words whatever
/// their case, the preferred one first.
struct DiscoverySettings {
  std::string patterns =
      "{loop}/*/{role}.CV; {loop}/*/{role}.ACTUAL; {loop}[./]{role}.CV; {loop}[./]PID*[./]{role}; "
      "{loop}[./_:-]{role}";
  std::string sp_words = "SP,SV,SETPOINT,SPT,SP_WRK,CSP,WSP";
  std::string pv_words = "PV,MEAS,PROCESS,PROCESSVALUE,MEASUREMENT,PV_IN";
  std::string op_words = "OP,OUT,CO,OUTPUT,CONTROLLEROUTPUT,LMN,CV,MV";
  std::string mv_words = "ZT,POS,POSITION,VP,ZI,FEEDBACK,RBK,MV";
  std::string mode_words = "MODE,MD,AUTO";
};

/// The whole settings file.
struct Settings {
  ResultsSettings results;
  std::vector<HistorianSettings> historians;
  ScheduleSettings schedule;
  DaemonSettings daemon;
  FlagSettings flags;
  DiscoverySettings discovery;
  core::AnalysisSettings analysis;
};

}  // namespace loopscope::config
