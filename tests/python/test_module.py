import inspect
import os
import re
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import svnet


def test_everything_public_has_a_docstring_and_a_signature():
    for name in svnet.__all__:
        if name == "__version__":
            continue
        public = getattr(svnet, name)
        assert public.__doc__, name
        if name not in ("Error", "Model"):  # no caller makes these
            assert "(" in str(inspect.signature(public)), name


def test_signatures_are_those_of_the_documentation():
    assert str(inspect.signature(svnet.kmeans)) == "(features, n_clusters, n_init=10, seed=0)"
    assert (
        str(inspect.signature(svnet.semantic_scores)) == "(features, category, object, pose, "
        "problems=None, min_samples=None, seed=0, singletons='zero')"
    )
    assert str(inspect.signature(svnet.Backbone)) == "(name, weights=None, layer=None, seed=0)"
    assert str(inspect.signature(svnet.Model.load)) == "(path)"
    assert str(inspect.signature(svnet.Model.score)) == "(self, image, angles_deg, depth=None)"
    best_views = "(self, image, angles_deg, k, min_angle_deg=0, depth=None)"
    assert str(inspect.signature(svnet.Model.best_views)) == best_views
    assert str(inspect.signature(svnet.Model.margin)) == "(self, image, angles_deg, depth=None)"
    grid = "(theta_steps=36, phi_steps=10, lowest_phi_deg=0, highest_phi_deg=90)"
    assert str(inspect.signature(svnet.pose_grid)) == grid
    assert str(inspect.signature(svnet.Model.best_view)) == "(self, image, angles_deg, depth=None)"


def test_version():
    assert re.fullmatch(r"\d+\.\d+\.\d+", svnet.__version__)


def test_error_is_a_value_error():
    assert issubclass(svnet.Error, ValueError)
    assert f"{svnet.Error.__module__}.{svnet.Error.__name__}" == "svnet.Error"


@pytest.mark.parametrize("n", [0, -1, 1025, 2.0, "two", None])
def test_set_threads_refuses(n):
    with pytest.raises(svnet.Error, match=r"\[set_threads\] n is "):
        svnet.set_threads(n)


@pytest.mark.parametrize("mode", ["On", "", 1, None])
def test_set_sandbox_refuses(mode):
    with pytest.raises(svnet.Error, match=r"\[set_sandbox\] mode"):
        svnet.set_sandbox(mode)


def test_calls_from_several_threads_while_the_number_of_threads_changes(random, threads):
    features = random.normal(size=(300, 8))
    expected = svnet.ward(features, 5)
    same = []

    def work():
        same.extend((svnet.ward(features, 5) == expected).all() for _ in range(10))

    workers = [threading.Thread(target=work) for _ in range(3)]
    for worker in workers:
        worker.start()
    for n in (1, 3, 2, 4) * 5:
        threads(n)
    for worker in workers:
        worker.join()
    assert len(same) == 30 and all(same)


def test_forked_processes_compute(random, threads):
    threads(2)
    features = random.normal(size=(300, 8))
    expected = svnet.ward(features, 5)
    child = os.fork()
    if child == 0:
        threads(3)
        os._exit(0 if (svnet.ward(features, 5) == expected).all() else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


class Raising:
    """Raises the exception from every method."""

    def __init__(self, exception):
        self.exception = exception

    def refuse(self, *_, **__):
        raise self.exception

    __array__ = __index__ = __fspath__ = refuse


@pytest.mark.parametrize(
    "use",
    [
        lambda given: svnet.ward(given, 1),
        lambda given: svnet.purity(given, [1]),
        lambda given: svnet.ward([[1.0]], given),
        svnet.set_threads,
        svnet.Model.load,
    ],
)
def test_only_what_says_that_a_value_does_not_fit_becomes_an_error(use):
    for kind in (TypeError, ValueError, OverflowError, UnicodeError):
        with pytest.raises(svnet.Error, match="expects"):
            use(Raising(kind("from the caller")))
    for kind in (KeyboardInterrupt, SystemExit, MemoryError, RuntimeError, ZeroDivisionError):
        with pytest.raises(kind, match="from the caller"):
            use(Raising(kind("from the caller")))


def test_values_in_messages_are_short():
    with pytest.raises(svnet.Error, match=r"^\[set_threads\] n is '(é){59}\.\.\.; expects"):
        svnet.set_threads("é" * 1000)
    with pytest.raises(svnet.Error, match=r"^\[set_threads\] n is <unprintable int object>; expects"):
        svnet.set_threads(1 << 100000)
    with pytest.raises(svnet.Error, match=r"n is array\(\[\[1\., 1\.\], +\[1\., 1\.\]\]\); expects"):
        svnet.set_threads(np.ones((2, 2)))


def run(script):
    """Runs the script in a new Python process, with numpy as np, svnet, os, signal and threading imported."""
    header = "import os, signal, threading\nimport numpy as np\nimport svnet\n"
    subprocess.run([sys.executable, "-c", header + textwrap.dedent(script)], check=True, timeout=60)


def test_a_signal_handler_may_compute_but_not_change_the_number_of_threads():
    run(
        """
        features = np.random.default_rng(1).normal(size=(60, 4))
        groups = np.arange(60)

        class Stop(Exception):
            pass

        def handler(*_):
            svnet.ward(features, 5)
            try:
                svnet.set_threads(1)
            except svnet.Error as error:
                assert "while a computation is interrupted" in str(error)
                raise Stop

        signal.signal(signal.SIGALRM, handler)
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        try:
            svnet.semantic_scores(features, groups // 15, groups // 3, groups, problems=2**32)
            assert False
        except Stop:
            pass
        svnet.set_threads(2)
        """
    )


def test_a_process_forked_while_others_compute_may_change_the_number_of_threads():
    run(
        """
        features = np.random.default_rng(1).normal(size=(60, 4))
        groups = np.arange(60)
        scores = lambda: svnet.semantic_scores(features, groups // 15, groups // 3, groups, problems=2**32)
        threading.Thread(target=scores, daemon=True).start()
        expected = svnet.ward(features, 5)
        for _ in range(20):
            child = os.fork()
            if child == 0:
                signal.alarm(10)
                svnet.set_threads(3)
                os._exit(0 if (svnet.ward(features, 5) == expected).all() else 1)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
        os._exit(0)
        """
    )


def test_threads_that_cannot_be_started_leave_those_that_there_are():
    run(
        """
        import resource
        import time

        def expect_threads(number):
            while len(os.listdir("/proc/self/task")) != number:  # one that was joined may be there for a moment
                time.sleep(0.01)

        features = np.random.default_rng(1).normal(size=(300, 8))
        expected = svnet.ward(features, 5)
        svnet.set_threads(3)
        before = len(os.listdir("/proc/self/task"))
        with open("/proc/self/statm") as file:
            used = int(file.read().split()[0]) * resource.getpagesize()
        limits = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (used + (256 << 20), limits[1]))  # each thread has a stack
        try:
            svnet.set_threads(1000)
            assert False
        except svnet.Error as error:
            assert "cannot start 1000 threads: " in str(error), error
        expect_threads(before)
        assert (svnet.ward(features, 5) == expected).all()
        resource.setrlimit(resource.RLIMIT_AS, limits)
        svnet.set_threads(4)
        expect_threads(before + 1)
        """
    )
