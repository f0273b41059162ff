import os
import pathlib
import shutil

import numpy as np
import pytest

_lines = []


@pytest.fixture
def report():
    """report(text): prints a line after all tests are done."""
    return _lines.append


def pytest_terminal_summary(terminalreporter):
    if _lines:
        terminalreporter.section("measured")
        for line in _lines:
            terminalreporter.write_line(line)


@pytest.fixture(scope="session")
def shared():
    """shared(path): a file or folder of the data that is too large for the repository. Skips the test if it is missing."""
    root = pathlib.Path(os.environ.get("SVNET_SHARED", pathlib.Path(__file__).parents[2].parent / "shared"))

    def find(relative):
        if not (root / relative).exists():
            pytest.skip(f"{root / relative} is missing")
        return root / relative

    return find


@pytest.fixture(scope="session")
def browser():
    """Chromium (Debian: chromium) with a camera that shows a test picture. One for all tests: Playwright's synchronous
    interface can be started only once at a time. Skips the test if there is no Chromium."""
    programs = ["chromium", "chromium-browser", "google-chrome"]
    program = next((found for name in programs if (found := shutil.which(name))), None)
    if program is None:
        pytest.skip("there is no Chromium here; on Debian: apt-get install chromium")
    playwright = pytest.importorskip("playwright.sync_api")
    camera = ["--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream"]
    with playwright.sync_playwright() as session:
        started = session.chromium.launch(executable_path=program, args=["--no-sandbox", *camera])
        yield started
        started.close()


def picture(path, size=224):
    """An image file as uint8 (size, size, 3), resized by PIL."""
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image.convert("RGB").resize((size, size), Image.BILINEAR))


@pytest.fixture(scope="session")
def photographs(shared):
    """64 photographs from all of ETH-80, uint8 (64, 224, 224, 3)."""
    paths = sorted(shared("data/eth80").rglob("*.jpg"))
    return np.stack([picture(path) for path in paths[:: len(paths) // 64][:64]])


@pytest.fixture(scope="session")
def drawings():
    """Synthetic images, uint8 (8, 224, 224, 3): smooth colours, edges and noise, some pixels saturated."""
    random = np.random.default_rng(224)
    y, x = np.mgrid[0:224, 0:224] / 224
    pictures = []
    for _ in range(8):
        waves = [np.sin(2 * np.pi * (random.normal(0, 4) * x + random.normal(0, 4) * y)) for _ in range(3)]
        disc = np.hypot(x - random.uniform(0.3, 0.7), y - random.uniform(0.3, 0.7)) < random.uniform(0.1, 0.4)
        image = 128 + 90 * np.stack(waves, axis=-1) + 80 * disc[..., None] * random.choice([-1, 1], size=3)
        pictures.append(np.clip(image + random.normal(0, 12, image.shape), 0, 255).astype(np.uint8))
    return np.stack(pictures)
