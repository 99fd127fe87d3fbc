#include "daemon/catalogue/naming_convention.hpp"

#include <algorithm>

#include "daemon/catalogue/tag_parts.hpp"
#include "daemon/catalogue/tag_pattern.hpp"
#include "daemon/text/split_list.hpp"

namespace loopscope::daemon {
namespace {

struct ConventionRow {
  const char* name;
  bool everyday;
  const char *sp, *pv, *op, *mv, *mode;
};

/// Names of parameters as the vendors document them; several conventions may fill a loop, and the
/// one that fills most of it is taken. A mode is left out where 1 means manual (Siemens AM_MAN,
/// Eurotherm AutoMan): a controller's mode must not be read upside down.
constexpr ConventionRow kConventions[] = {
    {"Rockwell PIDE", false, "SP,SPProg|SPOper|SPCascade", "PV", "CV,CVEU,CVProg|CVOper", "",
     "Auto"},
    {"Rockwell PlantPAx", false, "Val_SP,PSet_SP|OSet_SP", "Val_PV,Inp_PV",
     "Val_CVOut,Val_CVSet|Val_CV,PSet_CV|OSet_CV", "Val_Pos,Inp_PosFdbk", "Sts_Auto"},
    {"Siemens CTRL_PID", false, "SP,SP_OP|SP_EXT", "PV_IN,PV", "LMN", "LMNR_IN", "QMAN_AUT"},
    {"Siemens PIDConL", false, "SP,SP_Out,SP_Int|SP_Ext", "PV,PV_Out", "MV,LMN", "Rbk", "AutAct"},
    {"Siemens PID_Compact", true, "CurrentSetpoint,Setpoint", "ScaledInput,Input",
     "Output,Output_PER", "", ""},
    {"Foxboro PIDA", false, "SPT", "MEAS", "OUT", "", "MA"},
    {"ABB PIDCON", false, "WSP", "MV", "OUT", "", ""},
    {"Eurotherm", false, "WorkingSP,TargetSP", "PV", "ActiveOut,WorkingOutput", "", ""},
    {"Schneider PIDFF", false, "SP", "PV", "OUT", "", "MAN_AUTO"},
    {"X/W/Y", true, "W", "X", "Y", "", ""},
    {"Istwert/Sollwert", true, "Sollwert,Soll,Führungsgrösse|Führungsgröße|Fuehrungsgroesse",
     "Istwert,Ist,Regelgrösse|Regelgröße|Regelgroesse",
     "Stellwert,Stellgrösse|Stellgröße|Stellgroesse,Stellgrad,Stellsignal,Stell,Ausgang",
     "Stellungsrückmeldung|Stellungsrueckmeldung", "Betriebsart"},
    {"actual value", true,
     "SetValue,SetPoint,SetpointValue|fSetpointValue|rSetpoint,DesiredValue,TargetValue,SP",
     "ActValue,ActualValue|fActualValue|rActual,PresentValue,CurrentValue,ControlledVariable,"
     "ProcessValue,Actual",
     "ControlOutput,ControllerOutput,Output|fOut|rOutput,OutputValue,ManipulatedVariable,"
     "ManipulatedValue,ControlValue,OutValue,Out,OP",
     "", "Mode"},
    {"mesure/consigne", true, "Consigne,Consigna", "Mesure,Medida", "Sortie,Commande,Salida", "",
     ""},
};

NamingConvention convention_of(const ConventionRow& row) {
  NamingConvention convention{row.name, {}, row.everyday};
  convention.set("sp", row.sp);
  convention.set("pv", row.pv);
  convention.set("op", row.op);
  convention.set("mv", row.mv);
  convention.set("mode", row.mode);
  return convention;
}

}  // namespace

void NamingConvention::set(std::string_view role, std::string_view list) {
  Ranks ranks;
  std::vector<std::string> as_written;
  for (const std::string_view rank : split_list(list, ',')) {
    std::vector<std::string>& group = ranks.emplace_back();
    for (const std::string_view word : split_list(rank, '|')) {
      group.push_back(plain_word(word));
      as_written.push_back(lower_case(word));
    }
  }
  words.insert_or_assign(std::string(role), std::move(ranks));
  spelled.insert_or_assign(std::string(role), std::move(as_written));
}

std::optional<std::size_t> NamingConvention::rank(std::string_view role,
                                                  std::string_view word) const {
  const auto list = words.find(role);
  if (list == words.end()) return std::nullopt;
  for (std::size_t k = 0; k < list->second.size(); ++k) {
    if (std::ranges::find(list->second[k], word) != list->second[k].end()) return k;
  }
  return std::nullopt;
}

std::vector<NamingConvention> vendor_conventions() {
  std::vector<NamingConvention> conventions;
  for (const ConventionRow& row : kConventions) conventions.push_back(convention_of(row));
  return conventions;
}

}  // namespace loopscope::daemon
