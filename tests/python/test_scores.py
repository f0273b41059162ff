import numpy as np
import pytest

import svnet

# 4 categories of 2 objects with 1 pose of 3 views.
CATEGORY, OBJECT, VIEW = (a.ravel() for a in np.indices((4, 2, 3)))
POSE = np.zeros_like(OBJECT)


@pytest.fixture
def features(random):
    """The last view of each pose looks like the next category; the others look like their own."""
    return 5 * np.eye(16)[(CATEGORY + (VIEW == 2)) % 4] + 0.1 * random.normal(size=(len(CATEGORY), 16))


def scores(features, **options):
    return svnet.semantic_scores(features, CATEGORY, OBJECT, POSE, **options)


def test_views_that_tell_the_category_score_higher(features):
    found = scores(features, problems=20000)
    assert set(found) == {"individual", "global", "count", "standard_error"}
    assert found["count"].dtype == np.uint64
    assert all(found[name].dtype == np.float64 for name in ("individual", "global", "standard_error"))
    assert all(values.shape == (24,) for values in found.values())
    for name in ("individual", "global"):
        assert found[name][VIEW < 2].min() > found[name][VIEW == 2].max()
    assert (0 < found["standard_error"]).all() and (found["standard_error"] < 0.02).all()


def test_equal_features_of_a_category_score_one_in_every_problem_with_a_partner():
    found = scores(np.eye(4)[CATEGORY], problems=3000, singletons="skip")
    assert (found["individual"] == 1).all()


def test_counts_add_up_to_the_items_of_the_problems(features):
    # 3 or 4 categories with 1 or 2 objects each: 3.5 * 1.5 items on average.
    count = scores(features, problems=30000)["count"]
    assert count.sum() == pytest.approx(30000 * 3.5 * 1.5, rel=0.01)
    assert (scores(features, min_samples=3000)["count"] >= 3000).all()
    assert scores(features, min_samples=10**9, problems=100)["count"].sum() <= 800


def test_seed(features):
    first, again, other = (scores(features, problems=500, seed=seed) for seed in (3, 3, 4))
    for name in first:
        assert first[name].tobytes() == again[name].tobytes()
        assert first[name].tobytes() != other[name].tobytes()


@pytest.mark.parametrize("n", [2, 3, 8])
def test_number_of_threads_does_not_matter(n, features, threads):
    threads(1)
    expected = scores(features, problems=2000)
    threads(n)
    found = scores(features, problems=2000)
    for name in expected:
        assert found[name].tobytes() == expected[name].tobytes()


def test_group_numbers_may_have_any_dtype(features):
    expected = scores(features, problems=200)
    found = svnet.semantic_scores(
        features.astype("f4").tolist(), CATEGORY * -1000.0, OBJECT.astype("u1"), POSE.tolist(), problems=200
    )
    # Other category labels give other problems from the same distribution.
    assert found["count"].sum() == pytest.approx(expected["count"].sum(), rel=0.1)


@pytest.mark.parametrize(
    "options, message",
    [
        ({}, "nothing says when to stop; give problems or min_samples"),
        ({"problems": 0}, "problems is 0; expects a whole number from 1"),
        ({"problems": 1e5}, "problems is 100000.0; expects a whole number"),
        ({"min_samples": -5}, "min_samples is -5; expects a whole number from 1"),
        ({"problems": 1, "seed": 0.5}, "seed is 0.5; expects a whole number from 0"),
        ({"problems": 1, "singletons": "skipp"}, "no treatment of singletons 'skipp', did you mean 'skip'?"),
        ({"problems": 1, "singletons": None}, 'singletons is no str; expects "zero" or "skip"$'),
    ],
)
def test_options_that_are_refused(features, options, message):
    with pytest.raises(svnet.Error, match=message):
        scores(features, **options)


def test_data_that_are_refused(features):
    with pytest.raises(svnet.Error, match="23 rows of features, but 24 categories, objects and poses"):
        scores(features[1:], problems=1)
    with pytest.raises(svnet.Error, match=r"object has shape \(24, 1\)"):
        svnet.semantic_scores(features, CATEGORY, OBJECT[:, None], POSE, problems=1)
    with pytest.raises(svnet.Error, match="24.*23"):
        svnet.semantic_scores(features, CATEGORY, OBJECT, POSE[1:], problems=1)
    with pytest.raises(svnet.Error, match="categories"):
        svnet.semantic_scores(features, CATEGORY % 2, OBJECT, POSE, problems=1)


def test_interrupt_ends_a_long_computation(features):
    import signal
    import threading

    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        scores(features, problems=2**32)


def test_categories_may_be_strings():
    features = np.random.default_rng(5).normal(size=(24, 4))
    category, item = np.repeat(np.arange(4), 6), np.tile(np.repeat(np.arange(3), 2), 4)
    pose = np.tile([0, 1], 12)
    expected = svnet.semantic_scores(features, category, item, pose, problems=200)
    names = np.array(["ball", "cone", "cube", "ring"])[category]
    found = svnet.semantic_scores(features, names, np.array(["a", "b", "c"])[item], pose, problems=200)
    for key, values in expected.items():
        assert values.tobytes() == found[key].tobytes(), key
