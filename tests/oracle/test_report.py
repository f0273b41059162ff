"""The pages of svnet-crossval, svnet-eval and svnet-report in a browser, and what axe and tidy say of them.

Chromium (Debian: chromium) and tidy are used if they are installed; otherwise these tests skip.
"""
import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

CATEGORIES = ["awl", "bar & <b>rod", "cue", "fid", "peg", "spray bottle"]
VIEWS = [(45, 0), (45, 90), (45, 180), (60, 45), (75, 135), (90, 90)]


def bar(random, colour, angle):
    """A bar on a table from above, uint8 (64, 64, 3)."""
    y, x = np.mgrid[-1:1:64j, -1:1:64j]
    along, across = x * np.cos(angle) + y * np.sin(angle), -x * np.sin(angle) + y * np.cos(angle)
    image = np.full((64, 64, 3), 170.0)
    image[(np.abs(along) < 0.6) & (np.abs(across) < 0.15 + 0.05 * along)] = colour
    return np.clip(image + random.normal(0, 4, image.shape), 0, 255).astype(np.uint8)


@pytest.fixture(scope="session")
def pages(tmp_path_factory):
    """The page of a cross-validation, of a run with epochs, and of both side by side."""
    from PIL import Image

    folder = tmp_path_factory.mktemp("report")
    random = np.random.default_rng(5)
    for number, category in enumerate(CATEGORIES):
        colour = 40 + 30 * np.array([number % 2, number % 3, number])
        for item in range(1, 4):
            place = folder / "data" / category / str(item) / "1"
            place.mkdir(parents=True)
            for phi, theta in VIEWS:
                Image.fromarray(bar(random, colour, random.uniform(0, 6))).save(place / f"{phi}_{theta}.png")
    scores = "scores: {backbone: tiny_xception, problems: 300, min_categories: 2, rounds: 0}\n"
    evaluation = "evaluation: {problems: 60, pipelines: [tiny_xception_ward, tiny_xception_kmeans]}\n"
    (folder / "folds.yaml").write_text("preset: best\ndataset: {root: data}\n" + scores + evaluation)
    (folder / "epochs.yaml").write_text(
        "dataset: {root: data, held_out: [awl, cue, fid]}\n" + scores + evaluation +
        "sv_net: {backbone: tiny_xception, width: 8}\ntraining: {epochs: 3, validation_categories: 1}\n")

    def command(*words):
        program = pathlib.Path(os.environ["SVNET_BUILD"]) / "bin" / words[0]
        subprocess.run([program, *words[1:], "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)

    command("svnet-crossval", "folds.yaml", "--folds", "3", "--output", "folds")
    command("svnet-train", "epochs.yaml", "--output", "epochs")
    (folder / "epochs" / "timings.csv").write_text("stage,seconds,reused\nfeatures tiny_xception,1.5,0\nscores,.2,1\n")
    command("svnet-eval", "epochs", "--selectors", "top,rand,broadside,phi_map,svnet")
    command("svnet-report", "folds", "epochs", "--output", "both.html")
    return {"folds": folder / "folds/report.html", "epochs": folder / "epochs/report.html", "both": folder / "both.html"}


@pytest.mark.parametrize("name", ["folds", "epochs", "both"])
@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_in_a_browser(pages, browser, name, width, scheme):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page = context.new_page()
    complaints, requests = [], []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(pages[name].as_uri())
    page.evaluate("document.querySelectorAll('details').forEach(details => details.open = true)")
    assert page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") <= 0
    assert page.evaluate("[...document.images].every(image => image.complete && image.naturalWidth > 0)")
    violations = axe.Axe().run(page).response["violations"]
    assert [(rule["id"], rule["nodes"][0]["html"]) for rule in violations] == []
    assert complaints == []
    assert [url for url in requests if not url.startswith(("data:", pages[name].as_uri()))] == []
    context.close()


def test_links_of_the_page_lead_to_objects(pages, browser):
    page = browser.new_page()
    page.goto(pages["folds"].as_uri() + "#awl-3")
    assert "SV-net chose" in page.locator("#awl-3").or_(page.locator("table:has(#awl-3)")).first.inner_text()
    assert page.locator("nav a").count() >= 5
    for link in page.locator("nav a").all():
        assert page.locator(link.get_attribute("href")).count() == 1
    page.close()


@pytest.mark.parametrize("name", ["folds", "epochs", "both"])
def test_page_is_valid(pages, name):
    if shutil.which("tidy") is None:
        pytest.skip("there is no tidy here; on Debian: apt-get install tidy")
    checked = subprocess.run(["tidy", "-quiet", "-errors", str(pages[name])], capture_output=True, text=True)
    assert checked.stderr == "" and checked.returncode == 0


@pytest.mark.parametrize("name", ["folds", "epochs", "both"])
def test_page_is_small_and_stands_alone(pages, name):
    text = pages[name].read_text(encoding="utf-8")
    assert len(text.encode()) < 5_000_000
    assert "http" not in text and "<script" not in text and "<b>rod" not in text
