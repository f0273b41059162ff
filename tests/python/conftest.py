import signal

import numpy as np
import pytest


@pytest.fixture(autouse=True)
def interrupts():
    """Makes Ctrl-C raise KeyboardInterrupt. A shell that starts the tests in the background ignores SIGINT."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def random():
    return np.random.default_rng(20180725)


@pytest.fixture
def threads():
    """svnet.set_threads; afterwards there is one thread again."""
    import svnet

    yield svnet.set_threads
    svnet.set_threads(1)
