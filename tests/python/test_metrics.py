import math

import numpy as np
import pytest

import svnet

TRUE = [0, 0, 0, 1, 1, 2]
PRED = [0, 0, 1, 1, 1, 1]
# Pairs in one class: 3 + 1; in one cluster: 1 + 6; in both: 1 + 1.


def test_values_by_hand():
    assert svnet.fowlkes_mallows(TRUE, PRED) == pytest.approx(2 / math.sqrt(4 * 7), rel=1e-15)
    assert svnet.purity(TRUE, PRED) == 4 / 6
    expected = 4 * 7 / 15
    assert svnet.adjusted_rand(TRUE, PRED) == pytest.approx((2 - expected) / ((4 + 7) / 2 - expected), rel=1e-14)


def test_individual_values_by_hand():
    values = svnet.fowlkes_mallows_individual(TRUE, PRED)
    assert values.dtype == np.float64
    assert values == pytest.approx([1 / math.sqrt(2), 1 / math.sqrt(2), 0, 1 / math.sqrt(3), 1 / math.sqrt(3), 0])


def test_mutual_information_by_hand():
    def entropy(*shares):
        return -sum(p * math.log(p) for p in shares)

    truth, prediction = entropy(1 / 2, 1 / 3, 1 / 6), entropy(1 / 3, 2 / 3)
    information = truth + prediction - entropy(1 / 3, 1 / 6, 1 / 3, 1 / 6)
    arithmetic = svnet.normalized_mutual_info(TRUE, PRED)
    assert arithmetic == pytest.approx(2 * information / (truth + prediction), rel=1e-14)
    assert arithmetic == svnet.normalized_mutual_info(TRUE, PRED, average="arithmetic")
    geometric = svnet.normalized_mutual_info(TRUE, PRED, "geometric")
    assert geometric == pytest.approx(information / math.sqrt(truth * prediction), rel=1e-14)


METRICS = [
    svnet.fowlkes_mallows,
    svnet.normalized_mutual_info,
    svnet.purity,
    svnet.adjusted_rand,
    svnet.fowlkes_mallows_individual,
]


@pytest.mark.parametrize("metric", METRICS)
def test_labels_may_be_any_whole_numbers(metric):
    expected = np.asarray(metric(TRUE, PRED)).tobytes()
    truth, pred = np.array(TRUE), np.array(PRED)
    for dtype in ("i1", "u1", "i4", "u8", "f2", "f8", ">i8"):
        assert np.asarray(metric(truth.astype(dtype), pred.astype(dtype))).tobytes() == expected
    assert np.asarray(metric(truth * -(2**61), np.repeat(pred, 2)[::2] + 7)).tobytes() == expected
    assert np.asarray(metric(tuple(TRUE), pred == 1)).tobytes() == expected


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize(
    "truth, pred, message",
    [
        ([], [], "there are no labels"),
        ([0, 1], [0], "2.*1"),
        ([[0, 1]], [[0, 1]], r"true has shape \(1, 2\); expects \(N,\)"),
        ([0, 1], [1j, 0], "pred has dtype complex128; expects integers, floats or strings"),
        ([0, 1], np.array(["a", None]), "pred has dtype object"),
        ([0, 1], [0, 0.5], r"pred\[1\] is 0.5; expects whole numbers"),
        ([0, float("nan")], [0, 1], r"true\[1\] is nan"),
        ([0, float("inf")], [0, 1], r"true\[1\] is inf"),
        (np.array([0, 2**63], np.uint64), [0, 1], r"true\[1\] is 9223372036854775808, beyond int64"),
    ],
)
def test_labels_that_are_refused(metric, truth, pred, message):
    with pytest.raises(svnet.Error, match=message):
        metric(truth, pred)


def test_unknown_average():
    with pytest.raises(svnet.Error, match="there is no average 'geometrik', did you mean 'geometric'?"):
        svnet.normalized_mutual_info(TRUE, PRED, average="geometrik")
    for average in (None, 1, b"geometric"):
        with pytest.raises(svnet.Error, match='average is no str; expects "arithmetic" or "geometric"$'):
            svnet.normalized_mutual_info(TRUE, PRED, average)


@pytest.mark.parametrize("metric", METRICS)
def test_labels_may_be_strings(metric):
    expected = np.asarray(metric(TRUE, PRED)).tobytes()
    names = np.array(["cup", "apple", "\u00e9toile"])
    for truth in (names[TRUE], list(names[TRUE]), names[TRUE].astype(object), np.char.encode(names, "utf-8")[TRUE]):
        assert np.asarray(metric(truth, PRED)).tobytes() == expected
    assert np.asarray(metric(names[TRUE], np.array(["x", "y"])[PRED])).tobytes() == expected
