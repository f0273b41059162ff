"""Compares semantic scores with a plain Monte-Carlo that uses scikit-learn and other random numbers."""
import numpy as np
from sklearn.cluster import AgglomerativeClustering
from sklearn.metrics import fowlkes_mallows_score

import svnet


def draw(random, tree):
    """A problem of PAPER.md section 4: rows and their categories."""
    rows, categories = [], []
    chosen = random.choice(len(tree), size=random.integers(3, len(tree) + 1), replace=False)
    for category in chosen:
        objects = tree[category]
        for number in random.choice(len(objects), size=random.integers(1, len(objects) + 1), replace=False):
            pose = objects[number][random.integers(len(objects[number]))]
            rows.append(pose[random.integers(len(pose))])
            categories.append(category)
    return np.array(rows), np.array(categories)


def test_scores_agree_with_a_plain_simulation(report):
    random = np.random.default_rng(11)
    # 5 categories with different numbers of objects, poses and views.
    tree, groups = [], []
    for category in range(5):
        tree.append([])
        for number in range(2 + category % 3):
            tree[-1].append([])
            for pose in range(1 + number % 2):
                views = 2 + pose
                tree[-1][-1].append(list(range(len(groups), len(groups) + views)))
                groups += [(category, number, pose)] * views
    category, number, pose = np.array(groups).T
    features = 1.5 * np.eye(8)[category] + random.normal(size=(len(groups), 8))

    problems = 6000
    individual, total = [[] for _ in groups], [[] for _ in groups]
    for _ in range(problems):
        rows, truth = draw(random, tree)
        pred = AgglomerativeClustering(len(set(truth))).fit(features[rows]).labels_
        overall, single = fowlkes_mallows_score(truth, pred), svnet.fowlkes_mallows_individual(truth, pred)
        for row, score in zip(rows, single):
            individual[row].append(score)
            total[row].append(overall)

    found = svnet.semantic_scores(features, category, number, pose, problems=1_000_000)
    share = np.array([len(scores) for scores in individual]) / problems
    deviations = {"count": (found["count"] / 1e6 - share) / np.sqrt(share * (1 - share) / problems)}
    for name, samples in (("individual", individual), ("global", total)):
        errors = np.array([np.std(scores) / np.sqrt(len(scores)) for scores in samples])
        deviations[name] = (found[name] - [np.mean(scores) for scores in samples]) / errors
    for name, values in deviations.items():
        report(f"semantic scores, {name}: largest deviation {np.abs(values).max():.1f} standard errors of {len(values)} views")
        assert np.abs(values).max() < 4.5, name
    spread = np.array([np.std(scores) for scores in individual]) / np.sqrt(found["count"])
    assert np.abs(found["standard_error"] / spread - 1).max() < 0.1
