import numpy as np
import pytest


@pytest.fixture
def random():
    return np.random.default_rng(20180725)


@pytest.fixture
def threads():
    """svnet.set_threads, put back to one thread afterwards."""
    import svnet

    yield svnet.set_threads
    svnet.set_threads(1)
