"""Intervals, tests of pairs and causes, against simulations and against what is counted by hand."""

import itertools
import unittest
import warnings

import numpy as np

from mrroc_campaign import causes, charts, paired
from mrroc_campaign.groups import grouped
from mrroc_campaign.intervals import Sequence, clopper_pearson, confidence_sequence


class Statistics(unittest.TestCase):
    def test_interval_of_a_fixed_number_of_runs_covers_the_rate(self):
        from scipy.stats import binom

        for n in (1, 7, 40):
            ends = [clopper_pearson(k, n) for k in range(n + 1)]
            for p in np.linspace(0.001, 0.999, 97):
                covered = sum(binom.pmf(k, n, p) for k, (low, high) in enumerate(ends) if low <= p <= high)
                self.assertGreaterEqual(covered, 0.95 - 1e-12)
        self.assertEqual(clopper_pearson(0, 10)[0], 0)
        self.assertEqual(clopper_pearson(10, 10)[1], 1)

    def test_sequence_holds_the_rate_at_all_times_at_once(self):
        random, runs, ways = np.random.default_rng(3), 600, 400
        for p in (0.02, 0.3, 0.5, 0.97):
            ends = {}
            missed = 0
            for outcome in random.random((ways, runs)) < p:
                successes = np.cumsum(outcome)
                for n in range(1, runs + 1):  # somebody who stops as soon as the interval is wrong
                    at = int(successes[n - 1]), n
                    if at not in ends:
                        low, high = confidence_sequence(*at)
                        ends[at] = low <= p <= high
                    if not ends[at]:
                        missed += 1
                        break
            # at most 5 % of the ways, and three standard deviations of that number
            self.assertLessEqual(missed, 0.05 * ways + 3 * (0.05 * 0.95 * ways) ** 0.5, p)

    def test_exact_interval_would_not_bear_being_looked_at_all_the_time(self):
        # The same somebody, so that the test above is known to tell.
        random, missed = np.random.default_rng(4), 0
        for outcome in random.random((100, 300)) < 0.5:
            successes = np.cumsum(outcome)
            missed += any(
                not (low <= 0.5 <= high)
                for n in range(5, 301)
                for low, high in [clopper_pearson(int(successes[n - 1]), n)]
            )
        self.assertGreater(missed, 15)

    def test_sequence_gets_narrower_and_holds_the_share(self):
        widths = []
        for n in (1, 10, 100, 1000, 100000):
            for k in {0, 1, n // 3, n}:
                low, high = confidence_sequence(k, n)
                self.assertTrue(0 <= low <= k / n <= high <= 1)
            widths.append(np.diff(confidence_sequence(n // 2, n))[0])
        self.assertEqual(widths, sorted(widths, reverse=True))
        self.assertEqual(confidence_sequence(0, 0), (0, 1))

    def test_runs_count_in_the_order_of_the_plan_whichever_ends_first(self):
        random = np.random.default_rng(5)
        for _ in range(50):
            n = int(random.integers(1, 40))
            outcome, order = random.random(n) < 0.7, random.permutation(n)
            sequence = Sequence({})
            for k, run in enumerate(order):
                sequence.add(int(run), bool(outcome[run]))
                ended = set(order[: k + 1].tolist())
                prefix = next(i for i in range(n + 1) if i not in ended)
                self.assertEqual((sequence.runs, sequence.successes), (prefix, int(outcome[:prefix].sum())))

    def test_mcnemar_is_the_toss_of_a_coin(self):
        for only_a, only_b in ((0, 0), (1, 0), (5, 1), (3, 9)):
            found = paired.mcnemar(
                [(True, False)] * only_a + [(False, True)] * only_b + [(True, True)] * 4 + [(False, False)] * 2
            )
            n = only_a + only_b
            tosses = [sum(t) for t in itertools.product((0, 1), repeat=n)]
            extreme = sum(abs(t - n / 2) >= abs(only_a - n / 2) for t in tosses) / len(tosses)
            self.assertAlmostEqual(found.p, extreme, places=9)
            self.assertEqual((found.both, found.only_a, found.only_b, found.neither), (4, only_a, only_b, 2))

    def test_shift_of_a_figure_is_found_and_its_interval_covers_it(self):
        random, missed, rounds = np.random.default_rng(6), 0, 200
        for _ in range(rounds):
            a = random.normal(3, 1, 25)
            b = a + 0.4 + random.normal(0, 0.5, 25)
            found = paired.wilcoxon("x", a.tolist(), b.tolist())
            d = b - a
            self.assertAlmostEqual(
                found.difference, float(np.median([(d[i] + d[j]) / 2 for i in range(25) for j in range(i, 25)]))
            )
            missed += not found.low <= 0.4 <= found.high
        self.assertLessEqual(missed, 0.05 * rounds + 3 * (0.05 * 0.95 * rounds) ** 0.5)
        same = paired.wilcoxon("x", [1.0, 2.0], [1.0, 2.0])
        self.assertEqual((same.difference, same.p), (0, 1))

    def test_interval_of_the_shift_holds_for_few_pairs_too_and_below_six_there_is_none(self):
        # Ends by the tables of Wilcoxon's statistic (Hollander, Wolfe 1999, A.4): the C-th mean from either end.
        for n, c in ((6, 1), (7, 3), (8, 4), (10, 9), (15, 26), (20, 53)):
            d = np.arange(n) ** 1.5
            means = sorted((d[i] + d[j]) / 2 for i in range(n) for j in range(i, n))
            found = paired.wilcoxon("x", [0.0] * n, d.tolist())
            self.assertEqual((found.low, found.high), (means[c - 1], means[-c]), n)
        random, rounds = np.random.default_rng(10), 2000
        for n in (6, 7, 9, 12, 80):
            missed = 0
            for d in random.normal(0.4, 1, (rounds, n)):
                found = paired.wilcoxon("x", [0.0] * n, d.tolist())
                missed += not found.low <= 0.4 <= found.high
            self.assertLessEqual(missed, 0.05 * rounds + 3 * (0.05 * 0.95 * rounds) ** 0.5, n)
        for n in range(1, 6):
            found = paired.wilcoxon("x", [0.0] * n, random.normal(9, 1, n).tolist())
            self.assertTrue(np.isnan(found.low) and np.isnan(found.high))

    def test_signed_ranks_are_tosses_of_coins_with_equal_differences_and_zeros_too(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # none comes to the terminal
            for d in ([1, 1, 1, 1, 1], [1, -1, 2, 2, 0, 0], [0.5], [0, 0], [3, 1, -2, 5, 4, 7, -7, 8]):
                ranks = [sum((abs(y) < abs(x)) + (abs(y) == abs(x)) / 2 for y in d if y) + 0.5 for x in d if x]
                sums = [sum(r for r, s in zip(ranks, t) if s) for t in itertools.product((0, 1), repeat=len(ranks))]
                got = sum(r for r, x in zip(ranks, filter(None, d), strict=True) if x > 0)
                p = 2 * min(sum(s <= got for s in sums), sum(s >= got for s in sums)) / len(sums)
                self.assertAlmostEqual(paired.wilcoxon("x", [0.0] * len(d), d).p, min(1, p))
            self.assertLess(paired.wilcoxon("x", [0.0] * 99, [1.0] * 90 + [0.0] * 9).p, 1e-9)

    def test_correction_never_makes_a_figure_more_certain(self):
        random = np.random.default_rng(7)
        for _ in range(100):
            p = random.random(int(random.integers(1, 9))).tolist()
            corrected = paired.holm(p)
            self.assertTrue(all(c >= q for c, q in zip(corrected, p, strict=True)))
            self.assertAlmostEqual(min(corrected), min(1, min(p) * len(p)))
            self.assertEqual(np.argsort(p).tolist(), sorted(range(len(p)), key=lambda k: (corrected[k], p[k])))
        self.assertTrue(np.allclose(paired.holm([0.04, 0.01, 0.02]), [0.04, 0.03, 0.04]))

    def test_value_that_makes_runs_fail_comes_first_with_its_cut(self):
        random = np.random.default_rng(8)
        for _ in range(10):
            n, cut = 200, float(random.uniform(3, 7))
            x, y, word = random.uniform(0, 10, n), random.uniform(0, 1, n), random.choice(["a", "b"], n)
            failed = (x < cut) & (random.random(n) < 0.6)
            found = causes.dependences({"y": y.tolist(), "x": x.tolist(), "word": word.tolist()}, failed.tolist())
            self.assertEqual(found[0].key, "x")
            self.assertLess(found[0].p, 0.01)
            self.assertRegex(found[0].rule, r"^x <= ")
            self.assertAlmostEqual(float(found[0].rule.split()[-1]), cut, delta=0.6)
            self.assertEqual(found[0].inside[0] + found[0].outside[0], failed.sum())
            self.assertEqual(found[0].inside[1] + found[0].outside[1], n)

    def test_word_that_makes_runs_fail_is_named(self):
        words = ["a", "b", "c"] * 40
        found = causes.dependences({"word": words}, [w == "b" for w in words])
        self.assertEqual((found[0].rule, found[0].inside, found[0].outside), ("word = b", (40, 40), (0, 80)))

        found = causes.dependences({"word": words}, [w != "b" for w in words])
        self.assertEqual((found[0].rule, found[0].inside, found[0].outside), ("word is not b", (80, 80), (0, 40)))
        words = ["a", "b"] * 60
        self.assertEqual(causes.dependences({"word": words}, [w == "b" for w in words])[0].rule, "word = b")

    def test_values_without_influence_are_seldom_accused(self):
        random, accused, rounds = np.random.default_rng(9), 0, 60
        for k in range(rounds):
            values = {name: random.random(50).tolist() for name in "abcd"}
            accused += causes.dependences(values, (random.random(50) < 0.3).tolist(), seed=k)[0].p <= 0.05
        self.assertLessEqual(accused, 0.05 * rounds + 3 * (0.05 * 0.95 * rounds) ** 0.5)

    def test_nothing_is_told_where_all_runs_ended_alike(self):
        self.assertEqual(causes.dependences({"a": [1.0, 2.0]}, [False, False]), [])
        self.assertEqual(causes.dependences({"a": [1.0, 1.0]}, [True, False]), [])

    def test_equal_values_are_never_in_two_groups_and_a_frequent_one_is_alone(self):
        random = np.random.default_rng(3)
        for _ in range(200):
            values = random.integers(0, random.integers(1, 60), random.integers(1, 150)).tolist()
            found = grouped(values)
            self.assertEqual([x for group in found for x in group], sorted(set(values)))
            if len(set(values)) <= 10:
                self.assertTrue(all(len(group) == 1 for group in found))
            self.assertLessEqual(len(found), 13)
        continuous = random.random(120).tolist()
        self.assertEqual([len(group) for group in grouped(continuous)], [20] * 6)
        self.assertEqual(grouped([0.0] * 100 + continuous)[0], [0.0])

    def test_different_numbers_have_different_labels(self):
        self.assertEqual(charts.distinct([3.99, 3.9961, 4.0022]), ["3.99", "3.996", "4.002"])
        self.assertEqual(charts.distinct([1000.0, 2000.0]), ["1 k", "2 k"])
        self.assertEqual(charts.distinct([2.0, 2.0]), ["2", "2"])
