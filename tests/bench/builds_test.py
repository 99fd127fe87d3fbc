"""Ratios of two builds that are measured by turns."""

import math
import random
import unittest

from builds import Turns, ratio_of


class Ratios(unittest.TestCase):
    def test_a_loss_of_five_percent_is_seen_in_noise_that_both_share(self):
        rng = random.Random(1)
        machine = [math.exp(rng.gauss(0, 0.5)) for _ in range(8)]  # other work, in each round
        other = [10.0 * load * math.exp(rng.gauss(0, 0.01)) for load in machine]
        ours = [10.5 * load * math.exp(rng.gauss(0, 0.01)) for load in machine]
        found = ratio_of(ours, other)
        self.assertEqual(found["pairs"], 8)
        self.assertAlmostEqual(found["ratio"], 1.05, delta=3 * found["standard_error"])
        self.assertLess(found["detectable"], 0.05)

    def test_too_few_rounds_have_no_error(self):
        self.assertEqual(ratio_of([2.0], [1.0]),
                         {"ratio": 2.0, "standard_error": None, "detectable": None, "pairs": 1})
        self.assertIsNone(ratio_of([0.0], [1.0])["ratio"])

    def test_builds_begin_by_turns_and_are_compared_where_both_were_measured(self):
        turns = Turns(["ours", "other"])
        self.assertEqual([turns.of_round(0)[0], turns.of_round(1)[0]], ["ours", "other"])
        self.assertEqual(Turns(["ours"]).compared(), {})
        for value in (1.0, 2.0):
            turns.note("both", "ours", value)
            turns.note("both", "other", 2 * value)
        turns.note("new", "ours", 1.0)
        values = turns.values
        self.assertEqual(values["both"], [[1.0, 2.0], [2.0, 4.0]])
        self.assertEqual(ratio_of(*values["both"])["ratio"], 0.5)
        self.assertNotEqual(len(values["new"][0]), len(values["new"][1]))


if __name__ == "__main__":
    unittest.main()
