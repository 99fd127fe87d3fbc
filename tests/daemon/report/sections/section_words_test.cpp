#include <gtest/gtest.h>

#include "daemon/report/plant/event_box.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "daemon/report/sections/chain_table.hpp"
#include "daemon/report/sections/loop_list.hpp"
#include "daemon/report/sections/loop_section.hpp"
#include "tests/daemon/report/event_rows.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"

/// Every word of the sections as people read them, without the markup.
namespace loopscope::daemon {
namespace {

LoopReport flagged_loop() {
  LoopReport told;
  told.row = flagged_row(7, "FIC101");
  told.row.loop_type = "flow";
  told.row.source = "plant";
  told.row.summary = "The control valve sticks.";
  told.row.action = "Repair it.";
  told.row.reasons = {"It jumps.", "Figures:", "NGI 0.02."};
  return told;
}

TEST(SectionWords, ALoopOfTheList) {
  LoopReport told = flagged_loop();
  told.followed = {3, 40.0, "TIC2", "member", 0.1, "valve_stiction"};
  told.hidden = {{"victim", "", "", 0, {}, 4, {}}};
  told.trouble = "the historian is away";
  EXPECT_EQ(
      words_of(loop_section(told).html),
      "7 FIC101\n"
      "flow loop, source plant, priority 0.504 = severity 0.80 \u00d7 importance 1 \u00d7 kind "
      "1.00 "
      "\u00d7 confidence 0.63\n"
      "Valve stiction confidence 0.63 confirmed since 2026-03-01 12:00 UTC window until 2026-03-01 "
      "12:00 UTC\n"
      "Cause\n"
      "The control valve sticks.\n"
      "Source\n"
      "The source of plant-wide oscillation 1: repair this loop first, the affected loops follow.\n"
      "Follows\n"
      "10 % of its error follows plant-wide oscillation 3 of TIC2 (period 40 s).\n"
      "Not on the list\n"
      "Affected by plant-wide oscillation 4, whose source is not known.\n"
      "Action\n"
      "Repair it.\n"
      "Evidence\n"
      "It jumps.\n"
      "Figures\n"
      "NGI 0.02.\n"
      "Chance of evidence as strong as this in a loop without that fault: p 1e-05.\n"
      "No pictures of the window: the historian is away\n"
      "Data\n"
      "There is no problem with the data.\n");
}

TEST(SectionWords, ALoopThatIsOnlyShaken) {
  LoopReport told = flagged_loop();
  told.row.rank = 0;
  told.row.code = "healthy";
  told.row.summary = "Nothing was found that asks for action.";
  told.row.plant_oscillation_number.reset();
  told.row.p.reset();
  told.followed = {3, 40.0, "TIC2", "victim", 0.62, "external_disturbance"};
  EXPECT_EQ(
      words_of(loop_section(told).html),
      "FIC101\n"
      "flow loop, source plant\n"
      "External disturbance not flagged since 2026-03-01 12:00 UTC window until 2026-03-01 12:00 "
      "UTC\n"
      "Cause\n"
      "62 % of its error follows plant-wide oscillation 3 of TIC2 (period 40 s). By itself the "
      "loop is sound (healthy, confidence 0.63): Nothing was found that asks for action.\n"
      "Action\n"
      "Repair the source TIC2 first; this loop needs no work of its own; check again afterwards.\n"
      "Evidence\n"
      "It jumps.\n"
      "Figures\n"
      "NGI 0.02.\n"
      "Data\n"
      "There is no problem with the data.\n");
  told.followed->source_name.reset();
  const std::string words = words_of(loop_section(told).html);
  EXPECT_EQ(words.substr(words.find("Action\n"), words.find("Evidence") - words.find("Action\n")),
            "Action\n"
            "Find the source of the oscillation: what its loops have in common upstream; this loop "
            "needs no work of its own; check again afterwards.\n");
}

TEST(SectionWords, AnOscillationOfThreeLoops) {
  storage::PlantOscillationRow event = sample_event(3);
  event.members[0].reasons = {"It leads.", "Against it: the others lead it."};
  EXPECT_EQ(words_of(event_box(event, {}, LoopLinks::pages(), {}).html),
            "Plant-wide oscillation 1: period 40 s, 3 loops\n"
            "Source: L1. L1 leads.\n"
            "Found in windows until 1970-01-01 00:00 UTC.\n"
            "Where it comes from, probability\n"
            "L1 75 %\n"
            "For\n"
            "It leads.\n"
            "Against\n"
            "The others lead it.\n"
            "outside the recorded loops 13 %\n"
            "A common supply, a neighbouring unit, a loop that is not recorded, or the members "
            "together.\n"
            "Who follows whom\n"
            "1 L1\n"
            "source\n"
            "2 L2\n"
            "affected loop, 3 s behind\n"
            "3 L3\n"
            "affected loop, 6 s behind\n"
            "The source first, then by lag (a gain of the other sign looks like half a period). An "
            "arrow leads to a loop from the one whose past predicts it best, the thicker the "
            "better; the eight strongest members are compared.\n"
            "No. | Loop | Role | Share of its error | Lag | Probable source\n"
            "1 | L1 | source | 90 % | \u2013 | 75 %\n"
            "2 | L2 | affected loop | 45 % | 3 s behind | 1 %\n"
            "3 | L3 | affected loop | 30 % | 6 s behind | 1 %\n");
}

TEST(SectionWords, ThePlant) {
  PlantFacts facts = plant_facts("FIC101");
  facts.oscillations.clear();
  facts.flagged.resize(1);
  EXPECT_EQ(
      words_of(plant_section(facts, LoopLinks::sections({1, 2})).html),
      "13 loops 12 enabled\n"
      "9 judged newest window could be judged\n"
      "1 not in control service factor 93 %\n"
      "2 flagged action needed\n"
      "1 new since 2026-03-01 11:59 UTC\n"
      "3 fixed repairs since then\n"
      "1 unjudgeable why: below; 1 never analysed\n"
      "Work list 1 What to do Taken off the list 7 Repairs 1 Without a controller 1 Cannot be "
      "judged 1\n"
      "Work list\n"
      "Rank | Loop | Verdict | Confidence | Status | Since (UTC) | Priority\n"
      "1 | FIC101 FIC101 source of oscillation 1 | Valve stiction | 0.63 | confirmed | "
      "2026-03-01 12:00 new | 0.504\n"
      "Dead measurements first, then by priority = severity (1 less the middle of the Harris "
      "index) "
      "\u00d7 importance of the loop \u00d7 weight of the kind of fault \u00d7 confidence, shown "
      "with each loop. Status: not yet confirmed until a second window that shares no sample with "
      "the first says the same.\n"
      "Not on the list: 4 loops affected by a shared oscillation, 5 findings that people have "
      "acknowledged, suppressed or marked as false (below), 6 faults not sure enough (view "
      "hidden_loop).\n"
      "What to do\n"
      "Kind of fault | Loops | New | Action\n"
      "Valve stiction | 1 | 1 | Check in the field: put the controller in manual, step the output "
      "by 0.5 % at a time and watch when the stem moves; then packing, actuator and positioner.\n"
      "Taken off the list by people\n"
      "Loop | Verdict | What was said | By | When | Until | Reason\n"
      "FIC101 | Valve stiction | Acknowledged | FIC101 | 2026-03-01 12:00 UTC | work is entered | "
      "FIC101\n"
      "FIC101 | Tight tuning | Suppressed | eve | 2026-03-01 12:00 UTC | 2026-03-01 12:00 UTC | "
      "FIC101\n"
      "5 more, older than these: view hidden_loop. An acknowledged finding comes back when work "
      "done since is entered and a window that lies wholly after it shows the fault still; any, "
      "when what was said is withdrawn.\n"
      "Repairs, before and after\n"
      "Loop | Done | Work | Result | Why\n"
      "FIC101 | 2026-03-01 12:00 UTC | valve: FIC101 | improved | FIC101 error std 2 \u2192 1 "
      "units of pv (\u00d7 0.5, 0.44 to 0.57)\n"
      "In brackets the change with its 90 % interval, which holds the ordinary change of a loop "
      "that nobody touched.\n"
      "Loops without a controller\n"
      "Loop | Area | State | Since | In service, last 7 days\n"
      "FIC101 | FIC101 | manual, tracking or out of service | 2026-03-01 12:00 UTC | 25 %\n"
      "Loops that cannot be judged\n"
      "Loops | Reason | Which | What to do\n"
      "3 | FIC101 | FIC101, TIC9 and 1 more | FIC101\n");
  EXPECT_EQ(words_of(plant_section({}, LoopLinks::sections({1, 2})).html),
            "0 loops 0 enabled\n"
            "0 judged newest window could be judged\n"
            "0 not in control no mode or output recorded\n"
            "0 flagged action needed\n"
            "0 new since 1970-01-01 00:00 UTC\n"
            "0 fixed repairs since then\n"
            "0 unjudgeable 0 never analysed\n"
            "Work list\n"
            "No loop is flagged: nothing to act on.\n");
}

TEST(SectionWords, AllLoops) {
  storage::LoopRow row;
  row.name = "TIC2";
  row.code = "healthy";
  row.shown_code = "external_disturbance";
  row.confidence = 0.93;
  row.hidden_by = "affected by a shared oscillation";
  row.follows = "62 % of its error follows";
  row.health = "no_data";
  row.state = "off the list";
  storage::LoopRow never;
  never.name = "LIC3";
  never.state = "never analysed";
  EXPECT_EQ(
      words_of(loop_list({.loops = {row, never}, .fitting = 2, .all = 24}, {}, {}).html),
      "All verdicts\nAll states\nflagged\noff the list\nnot flagged\nnever analysed\ndisabled\n"
      "by Loop\nby Area\nby Unit\nby Verdict\nby Confidence\nby State\n"
      "by Rank\nby Window until\nreverse order\nShow\n1 to 2 of 2 (24 in all)\n"
      "Loop | Area | Unit | Verdict | Confidence | State | Rank | Window until | Monitor\n"
      "TIC2 | \u2013 | \u2013 | External disturbance by itself healthy | 0.93 | off the list "
      "affected by a shared oscillation 62 % of its error follows | \u2013 | \u2013 | no data\n"
      "LIC3 | \u2013 | \u2013 | \u2013 | \u2013 | never analysed | \u2013 | \u2013\n");
}

TEST(SectionWords, TheStepsOfAModel) {
  core::model::Explanation told;
  told.excited = true;
  core::model::Step stiction;
  stiction.effect = core::model::EffectKind::valve_stiction;
  stiction.parameters = {{"S", "%", 5.0, 4.5, 5.5}, {"J", "%", 2.0, {}, {}}};
  stiction.law = "kano";
  stiction.holdout_error_before = 0.125;
  stiction.holdout_error_after = 0.0625;
  stiction.asked_by = {{"op_direction", 0.0, 0.31, "It depends on op."},
                       {"op_level", 0.004, {}, ""}};
  core::model::Step wave;
  wave.effect = core::model::EffectKind::external_oscillation;
  wave.holdout_error_before = 0.0625;
  wave.holdout_error_after = 0.05;
  told.steps = {stiction, wave};
  EXPECT_EQ(words_of(chain_table(told, {}).html),
            "What led to each effect. Both pictures of a row have one scale and show the stretch "
            "in which the effect lowers the error most.\n"
            "Residual before | Test that spoke | Effect | Residual after\n"
            "error 0.125\n"
            "op direction p &lt; 1e-12 It depends on op.\n"
            "op level p = 0.004\n"
            "valve stiction S 5 % (4.5 to 5.5); J 2 %; law kano\n"
            "error 0.0625, op direction p = 0.31\n"
            "error 0.0625\n"
            "no residual test: a first screening\n"
            "external oscillation\n"
            "error 0.05\n");
  told.noise_floor = 0.04;
  told.baseline = {"one lag", 0.125, {}};
  told.process_doubt = "The process is doubtful.";
  EXPECT_EQ(words_of(explanation_table(told).html),
            "Errors are mean squares in units of pv squared, one step, on samples that the fit has "
            "not seen; evidence is n ln(before / after).\n"
            "Stage | Figures (90 % interval) | Error before | Error after | Evidence | p\n"
            "Linear model | one lag | \u2013 | 0.125 | \u2013 | \u2013\n"
            "+ valve stiction | S 5 % (4.5 to 5.5); J 2 %; law kano | 0.125 | 0.0625 | 0 | 1\n"
            "+ external oscillation | | 0.0625 | 0.05 | 0 | 1\n"
            "Noise floor | what a perfect model would leave | \u2013 | 0.04 | \u2013 | \u2013\n"
            "The effects take 60 % off the error of the linear model; how sure they are is what "
            "evidence and p say.\n"
            "The model explains all of the explainable error (residual whiteness p 1).\n"
            "The process is doubtful.\n");
  told.baseline = {"one lag, gain 2.5 pv per %", 0.125, {}};
  EXPECT_NE(words_of(explanation_table(told, "m3/h").html).find("gain 2.5 m3/h per %"),
            std::string::npos);
  told.excited = false;
  told.excitation = "Not excited: op does not move.";
  EXPECT_EQ(words_of(explanation_table(told).html),
            "The process could not be identified. Not excited: op does not move.\n");
}

}  // namespace
}  // namespace loopscope::daemon
