#include "daemon/catalogue/naming_convention.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/catalogue/discover_loops.hpp"
#include "tests/daemon/catalogue/found_loops.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAreArray;
using testing::IsEmpty;

/// Tags as a site has them and the loops that they are.
struct Plant {
  const char* convention;
  std::vector<std::string> tags;    ///< of loops
  std::vector<std::string> decoys;  ///< of the same site; of no loop, or of no role
  std::vector<std::string> loops;
};

const std::vector<Plant>& plants() {
  static const std::vector<Plant> all{
      {"dot",
       {"FIC101.PV", "FIC101.SP", "FIC101.OP", "FIC101.MODE"},
       {"FIC101.PV.HI", "FIC101.PVHI", "FIC101.SP_H", "FIC101.HI", "FIC101.EU", "TI-100.PV"},
       {"FIC101: sp=FIC101.SP pv=FIC101.PV op=FIC101.OP mode=FIC101.MODE"}},
      {"lower case, slash",
       {"area1/tic12/pv", "area1/tic12/sp", "area1/tic12/out"},
       {"area1/tic12/pv_hi", "area1/ti13/pv", "area1/tic12/gain"},
       {"area1/tic12: sp=area1/tic12/sp pv=area1/tic12/pv op=area1/tic12/out"}},
      {"underscore",
       {"TIC_102_PV", "TIC_102_SP", "TIC_102_CO"},
       {"TIC_102_PV_HI", "TIC_102_SP_HH", "TIC_102_HI_SP", "FIC_9_TOT_PV", "FIC_9_TOT_SP"},
       {"TIC_102: sp=TIC_102_SP pv=TIC_102_PV op=TIC_102_CO"}},
      {"no separator",
       {"FIC209PV", "FIC209SP", "FIC209OP", "21LC007SV", "21LC007PV", "21LC007MV"},
       {"FIC209PVHI", "FIC209HSP", "SOLARPV", "SUPV", "UPS1PV", "FQ209PV"},
       {"21LC007: sp=21LC007SV pv=21LC007PV op=21LC007MV",
        "FIC209: sp=FIC209SP pv=FIC209PV op=FIC209OP"}},
      {"Honeywell Experion",
       {"FIC103.PIDA.PV", "FIC103.PIDA.SP", "FIC103.PIDA.OP", "FIC103.PIDA.MODE",
        "41FIC20021_PIDA.PV", "41FIC20021_PIDA.SP", "41FIC20021_PIDA.OP"},
       {"FIC103.PIDA.PVEUHI", "FIC103.PIDA.OPHILM", "FIC103.PIDA.SPHILM", "FIC103.DACA.PVRAW",
        "FIC103.PIDA.PVHIALM.TP", "FI104.DACA.PV"},
       {"41FIC20021: sp=41FIC20021_PIDA.SP pv=41FIC20021_PIDA.PV op=41FIC20021_PIDA.OP",
        "FIC103: sp=FIC103.PIDA.SP pv=FIC103.PIDA.PV op=FIC103.PIDA.OP mode=FIC103.PIDA.MODE"}},
      {"Foxboro",
       {"UNIT2:FIC104.MEAS", "UNIT2:FIC104.SPT", "UNIT2:FIC104.OUT", "UNIT2:FIC104.MA"},
       {"UNIT2:FIC104.HSCO1", "UNIT2:FIC104.RSP", "UNIT2:FI105.MEAS", "UNIT2:FI105.HHALIM"},
       {"UNIT2:FIC104: sp=UNIT2:FIC104.SPT pv=UNIT2:FIC104.MEAS op=UNIT2:FIC104.OUT "
        "mode=UNIT2:FIC104.MA"}},
      {"Rockwell PID",
       {"FIC105/PV", "FIC105/SP", "FIC105/CV"},
       {"FIC105/PVEUMax", "FIC105/SWM"},
       {"FIC105: sp=FIC105/SP pv=FIC105/PV op=FIC105/CV"}},
      {"Rockwell PIDE",
       {"[PLC1]FIC106.PV", "[PLC1]FIC106.SPProg", "[PLC1]FIC106.CVEU", "[PLC1]TIC107.PV",
        "[PLC1]TIC107.SP", "[PLC1]TIC107.SPProg", "[PLC1]TIC107.SPOper", "[PLC1]TIC107.CV",
        "[PLC1]TIC107.CVEU", "[PLC1]TIC107.Auto"},
       {"[PLC1]FIC106.SPHLimit", "[PLC1]FIC106.CVHLimit", "[PLC1]FIC106.PVEUMax",
        "[PLC1]TIC107.Manual", "[PLC1]TIC107.PVHAlarm", "[PLC1]TIC107.PVPercent",
        "[PLC1]TIC107.SPLLimit", "[PLC1]TIC107.CVROCLimit"},
       {"[PLC1]FIC106: sp=[PLC1]FIC106.SPProg pv=[PLC1]FIC106.PV op=[PLC1]FIC106.CVEU",
        "[PLC1]TIC107: sp=[PLC1]TIC107.SP pv=[PLC1]TIC107.PV op=[PLC1]TIC107.CV "
        "mode=[PLC1]TIC107.Auto"}},
      {"Rockwell PlantPAx",
       {"FIC108.Val_PV", "FIC108.Val_SP", "FIC108.Val_CVOut", "FIC108.Sts_Auto"},
       {"FIC108.Val_CVOutPercent", "FIC108.Cfg_SPHiLim", "FIC108.Val_Fault", "FV108.Val_CVOut",
        "TI109.Val"},
       {"FIC108: sp=FIC108.Val_SP pv=FIC108.Val_PV op=FIC108.Val_CVOut mode=FIC108.Sts_Auto"}},
      {"PCS 7 CTRL_PID",
       {"FIC110/PID.PV_IN", "FIC110/PID.SP_OP", "FIC110/PID.LMN", "FIC110/PID.QMAN_AUT"},
       {"FIC110/PID.PVH_ALM", "FIC110/PID.LMN_HLM", "FIC110/PID.MAN_OP", "FIC110/PID.ER"},
       {"FIC110: sp=FIC110/PID.SP_OP pv=FIC110/PID.PV_IN op=FIC110/PID.LMN "
        "mode=FIC110/PID.QMAN_AUT"}},
      {"PCS 7 #Value",
       {"SystemArchive\\FIC111/PID.PV_Out#Value", "SystemArchive\\FIC111/PID.SP#Value",
        "SystemArchive\\FIC111/PID.LMN#Value", "SystemArchive\\TIC112/PIDConL.PV#Value",
        "SystemArchive\\TIC112/PIDConL.SP#Value", "SystemArchive\\TIC112/PIDConL.MV#Value",
        "SystemArchive\\TIC112/PIDConL.Rbk#Value"},
       {"SystemArchive\\FIC111/PID.PV_Out#ST", "SystemArchive\\FIC111/PID.PV_Unit",
        "SystemArchive\\LI113/MonAnalog.PV_Out#Value", "SystemArchive\\YC114/Valve$Analog.MV#Value",
        "SystemArchive\\TIC112/PIDConL.PV_AH_Lim"},
       {"SystemArchive\\FIC111: sp=SystemArchive\\FIC111/PID.SP#Value "
        "pv=SystemArchive\\FIC111/PID.PV_Out#Value op=SystemArchive\\FIC111/PID.LMN#Value",
        "SystemArchive\\TIC112: sp=SystemArchive\\TIC112/PIDConL.SP#Value "
        "pv=SystemArchive\\TIC112/PIDConL.PV#Value op=SystemArchive\\TIC112/PIDConL.MV#Value "
        "mv=SystemArchive\\TIC112/PIDConL.Rbk#Value"}},
      {".PV.Value",
       {"Plant.PIC115.PV.Value", "Plant.PIC115.SP.Value", "Plant.PIC115.OP.Value"},
       {"Plant.PIC115.PV.Quality", "Plant.PIC115.PV.HiLim", "Plant.PI116.PV.Value",
        "Plant.PIC115.SP.HiLim", "Plant.PIC115.OP.HiLim"},
       {"Plant.PIC115: sp=Plant.PIC115.SP.Value pv=Plant.PIC115.PV.Value "
        "op=Plant.PIC115.OP.Value"}},
      {"ABB 800xA",
       {"FIC117:PV,Value", "FIC117:SP,Value", "FIC117:OUT,Value"},
       {"FIC117:PV,Status", "FIC117:PV,Max", "FIC117:SP,Max", "FIC117:OUT,Max", "FI118:PV,Value"},
       {"FIC117: sp=FIC117:SP,Value pv=FIC117:PV,Value op=FIC117:OUT,Value"}},
      {"ABB PIDCON",
       {"FIC119.MV", "FIC119.WSP", "FIC119.OUT"},
       {"FI120.MV", "FIC119.MVH1"},
       {"FIC119: sp=FIC119.WSP pv=FIC119.MV op=FIC119.OUT"}},
      {"DeltaV",
       {"FIC-121/PID1/PV.CV", "FIC-121/PID1/SP.CV", "FIC-121/PID1/OUT.CV",
        "FIC-121/PID1/MODE.ACTUAL", "TIC-122/AI1/PV.CV", "TIC-122/PID1/SP.CV",
        "TIC-122/PID1/OUT.CV"},
       {"FIC-121/PID1/MODE.TARGET", "FIC-121/PID1/PV.ST", "FIC-121/HI_LIM.CV", "FIC-121/AI1/OUT.CV",
        "FIC-121/AO1/OUT.CV", "FIC-121/AO1/SP.CV", "FIC-121/AO1/PV.CV",
        "FIC-121/PID1/OUT_HI_LIM.CV", "FIC-121/PID1/PV_SCALE.EU100", "TI-123/AI1/PV.CV",
        "TI-123/AI1/OUT.CV"},
       {"FIC-121: sp=FIC-121/PID1/SP.CV pv=FIC-121/PID1/PV.CV op=FIC-121/PID1/OUT.CV "
        "mode=FIC-121/PID1/MODE.ACTUAL",
        "TIC-122: sp=TIC-122/PID1/SP.CV pv=TIC-122/AI1/PV.CV op=TIC-122/PID1/OUT.CV"}},
      {"Yokogawa CENTUM",
       {"21FC005.PV", "21FC005.SV", "21FC005.MV", "21FC005.MODE"},
       {"21FC005.SUM", "21FC005.PH", "21FC005.MH", "21FC005.SVH", "21FQ006.PV", "21FI007.PV"},
       {"21FC005: sp=21FC005.SV pv=21FC005.PV op=21FC005.MV mode=21FC005.MODE"}},
      {"transmitter",
       {"FT-210", "FIC-210.SP", "FIC-210.OP", "U2/PDT-7A.PV", "U2/PDIC-7A.SP", "U2/PDIC-7A.OUT"},
       {"FT-211", "TT-210", "FT-210.HI", "FFIC-212.SP", "PT-7"},
       {"FIC-210: sp=FIC-210.SP pv=FT-210 op=FIC-210.OP",
        "U2/PDIC-7A: sp=U2/PDIC-7A.SP pv=U2/PDT-7A.PV op=U2/PDIC-7A.OUT"}},
      {"whole words",
       {"Boiler/LIC124/ProcessVariable", "Boiler/LIC124/Setpoint", "Boiler/LIC124/ControlOutput",
        "TIC125.ActValue", "TIC125.SetValue", "TIC125.ControlOutput"},
       {"Boiler/LIC124/ProcessVariableUnit", "Press1.ActValue", "Press1.SetValue",
        "Boiler/LIC124/SetpointHigh"},
       {"Boiler/LIC124: sp=Boiler/LIC124/Setpoint pv=Boiler/LIC124/ProcessVariable "
        "op=Boiler/LIC124/ControlOutput",
        "TIC125: sp=TIC125.SetValue pv=TIC125.ActValue op=TIC125.ControlOutput"}},
      {"X/W/Y",
       {"R126.X", "R126.W", "R126.Y", "FIC127_X", "FIC127_W"},
       {"CRANE.X", "CRANE.Y", "CRANE.Z", "P1_W", "P2_X", "LIC128.Y"},
       {"FIC127: sp=FIC127_W pv=FIC127_X", "R126: sp=R126.W pv=R126.X op=R126.Y"}},
      {"Istwert/Sollwert",
       {"Ofen.Temp3.Istwert", "Ofen.Temp3.Sollwert", "Ofen.Temp3.Stellwert", "TIC129_Ist",
        "TIC129_Soll"},
       {"Waage.Gewicht.Istwert", "Waage.Gewicht.Sollwert", "Ofen.Temp3.Grenzwert"},
       {"Ofen.Temp3: sp=Ofen.Temp3.Sollwert pv=Ofen.Temp3.Istwert op=Ofen.Temp3.Stellwert",
        "TIC129: sp=TIC129_Soll pv=TIC129_Ist"}},
      {"OPC UA",
       {"ns=2;s=Area.FIC130.PV", "ns=2;s=Area.FIC130.SP", "ns=2;s=Area.FIC130.OP",
        "ns=3;s=\"FIC131\".\"PV\"", "ns=3;s=\"FIC131\".\"SP\"", "ns=3;s=\"FIC131\".\"LMN\""},
       {"ns=2;s=Area.FIC130.PV.EURange", "ns=2;s=Area.TI132.PV"},
       {"Area.FIC130: sp=ns=2;s=Area.FIC130.SP pv=ns=2;s=Area.FIC130.PV "
        "op=ns=2;s=Area.FIC130.OP",
        "FIC131: sp=ns=3;s=\"FIC131\".\"SP\" pv=ns=3;s=\"FIC131\".\"PV\" "
        "op=ns=3;s=\"FIC131\".\"LMN\""}},
      {"Ignition",
       {"[default]U1/LIC133/PV", "[default]U1/LIC133/SP", "[default]U1/LIC133/CV"},
       {"[default]U1/LIC133/PV_EngHigh", "[default]U1/LI134/PV"},
       {"[default]U1/LIC133: sp=[default]U1/LIC133/SP pv=[default]U1/LIC133/PV "
        "op=[default]U1/LIC133/CV"}},
      {"Kepware",
       {"Channel1.Device1.FIC135_PV", "Channel1.Device1.FIC135_SP", "Channel1.Device1.FIC135_OUT"},
       {"Channel1.Device1._System._Error", "Channel1.Device1.FIC135_SP_HI"},
       {"Channel1.Device1.FIC135: sp=Channel1.Device1.FIC135_SP pv=Channel1.Device1.FIC135_PV "
        "op=Channel1.Device1.FIC135_OUT"}},
      {"iFIX",
       {"FIX.FIC136_PV.F_CV", "FIX.FIC136_SP.F_CV", "FIX.FIC136_OP.F_CV"},
       {"FIX.FIC136_PV.A_DESC", "FIX.FIC136_PV.F_HI", "FIX.FIC136_SP.F_HI", "FIX.TI137_PV.F_CV"},
       {"FIX.FIC136: sp=FIX.FIC136_SP.F_CV pv=FIX.FIC136_PV.F_CV op=FIX.FIC136_OP.F_CV"}},
      {"WinCC OA",
       {"System1:FIC138.pv.value:_online.._value", "System1:FIC138.sp.value:_online.._value",
        "System1:FIC138.out.value:_online.._value"},
       {"System1:FIC138.pv.limits.hi:_online.._value", "System1:TI139.pv.value:_online.._value"},
       {"System1:FIC138: sp=System1:FIC138.sp.value:_online.._value "
        "pv=System1:FIC138.pv.value:_online.._value op=System1:FIC138.out.value:_online.._value"}},
      {"Siemens PID_Compact",
       {"PLC.PIC140.ScaledInput", "PLC.PIC140.Setpoint", "PLC.PIC140.Output"},
       {"PLC.PIC140.InputPerHWError", "PLC.PIC140.Config.OutputUpperLimit", "PLC.M1.Output",
        "PLC.M1.Input"},
       {"PLC.PIC140: sp=PLC.PIC140.Setpoint pv=PLC.PIC140.ScaledInput op=PLC.PIC140.Output"}},
      {"Eurotherm",
       {"Loop.1.Main.PV", "Loop.1.Main.WorkingSP", "Loop.1.Main.ActiveOut"},
       {"Loop.1.OP.OutputHighLimit", "Loop.1.SP.RangeHigh"},
       {"Loop.1.Main: sp=Loop.1.Main.WorkingSP pv=Loop.1.Main.PV op=Loop.1.Main.ActiveOut"}},
  };
  return all;
}

std::vector<std::string> tags_of(const Plant& plant) {
  std::vector<std::string> tags = plant.decoys;
  tags.insert(tags.end(), plant.tags.begin(), plant.tags.end());
  return tags;
}

TEST(NamingConventions, EachIsFoundAndNothingElse) {
  EXPECT_GE(plants().size(), 21u);
  for (const Plant& plant : plants()) {
    SCOPED_TRACE(plant.convention);
    EXPECT_THAT(found_loops(discover_loops(tags_of(plant), naming_rules({}, {}, {}))),
                ElementsAreArray(plant.loops));
  }
}

/// Of decoys alone no loop is made.
TEST(NamingConventions, DecoysAreNoLoops) {
  for (const Plant& plant : plants()) {
    SCOPED_TRACE(plant.convention);
    EXPECT_THAT(found_loops(discover_loops(plant.decoys, naming_rules({}, {}, {}))), IsEmpty());
  }
}

TEST(NamingConventions, AllInOneHistorian) {
  std::vector<std::string> tags, loops;
  for (const Plant& plant : plants()) {
    const std::vector<std::string> of_plant = tags_of(plant);
    tags.insert(tags.end(), of_plant.begin(), of_plant.end());
    loops.insert(loops.end(), plant.loops.begin(), plant.loops.end());
  }
  std::vector<std::string> found = found_loops(discover_loops(tags, naming_rules({}, {}, {})));
  std::sort(found.begin(), found.end());
  std::sort(loops.begin(), loops.end());
  EXPECT_THAT(found, ElementsAreArray(loops));
}

}  // namespace
}  // namespace loopscope::daemon
