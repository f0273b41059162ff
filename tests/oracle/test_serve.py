"""The page of svnet-serve in a browser, what axe and tidy say of it, and the description of its interface.

Chromium (Debian: chromium) and tidy are used if they are installed; otherwise these tests skip.
"""
import json
import shutil
import subprocess

import numpy as np
import pytest
from serve_process import files, form, serve  # noqa: F401: fixtures

TOKEN = "a-token-of-the-tests-0123456789"


class Page:
    """The page of a server, with what it complains of and asks for."""

    def __init__(self, browser, address, width=1280, scheme="light"):
        self.context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme,
                                           permissions=["camera", "clipboard-read", "clipboard-write"])
        self.page = self.context.new_page()
        self.complaints, self.requests = [], []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.address = address
        self.page.goto(address)

    def choose(self, image, depth=None):
        self.page.set_input_files("#image-file", image)
        if depth:
            self.page.set_input_files("#depth-file", depth)
        self.page.locator("#results").wait_for(state="visible")
        self.page.locator("#json:not(:empty)").wait_for()

    def shown_json(self):
        """The camera that is shown, once it is that of the last change."""
        self.page.wait_for_timeout(500)
        return json.loads(self.page.locator("#json").inner_text())

    def facts(self):
        return self.page.locator("#best-facts").inner_text()

    def violations(self):
        axe = pytest.importorskip("axe_playwright_python.sync_playwright")
        found = axe.Axe().run(self.page).response["violations"]
        return [(rule["id"], [node["html"] for node in rule["nodes"]]) for rule in found]

    def overflow(self):
        return self.page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")

    def check_manners(self):
        assert self.complaints == []
        assert [url for url in self.requests if not url.startswith((self.address, f"blob:{self.address}"))] == []
        self.context.close()


@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_in_a_browser(serve, browser, files, width, scheme):
    page = Page(browser, serve("depth").address, width, scheme)
    page.page.locator("#depth-panel").wait_for(state="visible")
    assert page.violations() == [] and page.overflow() <= 0
    page.choose(files / "top.png", files / "depth.npy")
    page.page.evaluate("document.querySelectorAll('details').forEach(details => details.open = true)")
    assert page.violations() == [] and page.overflow() <= 0
    assert page.page.evaluate("[...document.images].every(image => image.complete && image.naturalWidth > 0)")
    assert page.page.locator("#table tbody tr").count() == 10
    colours = page.page.evaluate("""() => {
        const canvas = document.getElementById("sphere");
        const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        const found = new Set();
        for (let i = 0; i < data.length; i += 4) found.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
        return found.size;
    }""")
    assert colours > 100
    page.check_manners()


def test_page_shows_what_the_interface_answers(serve, browser, files):
    server = serve("axis")
    page = Page(browser, server.address)
    page.choose(files / "top.jpg")
    status, body = server.ask("POST", "/v1/predict?grid=even&count=400&lowest_phi_deg=45&radius_m=0.5",
                              (files / "top.jpg").read_bytes(), {"Content-Type": "image/jpeg"})
    assert status == 200
    best = json.loads(body)["best"]
    assert page.shown_json() == best
    assert np.allclose(json.loads(page.page.locator("#matrix").inner_text()), best["camera_pose"]["camera_to_world"],
                       atol=1e-6)
    page.page.fill("#radius", "0.25")
    page.page.fill("#centre-x", "0.4")
    page.page.select_option("#frame", "paper")
    camera = page.shown_json()["camera_pose"]
    assert camera["frame"] == "paper" and camera["radius_m"] == 0.25 and camera["centre_m"] == [0.4, 0, 0]
    for name in ["matrix", "json"]:
        page.page.locator(f"button[data-copies={name}]").click()
        page.page.wait_for_timeout(200)
        assert page.page.evaluate("navigator.clipboard.readText()") == page.page.locator(f"#{name}").inner_text()
    page.page.locator("summary").click()
    page.page.select_option("#grid", "paper")
    page.page.get_by_text("22 camera poses scored.").wait_for()
    page.check_manners()


def test_region_is_painted_erased_and_reset(serve, browser, files):
    page = Page(browser, serve("axis").address)
    page.choose(files / "top.png")
    assert "400 of 400 candidates" in page.facts()
    best = page.shown_json()
    page.page.locator("#from-above").click()
    sphere = page.page.locator("#sphere")
    sphere.scroll_into_view_if_needed()
    box = sphere.bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    radius = 0.39 * box["width"]

    def drag(right, down, steps=10):
        page.page.mouse.move(*middle)
        page.page.mouse.down()
        page.page.mouse.move(middle[0] + right, middle[1] + down, steps=steps)
        page.page.mouse.up()

    # From the top view down to the azimuth opposite to the best one: 0 is to the left, 90 below.
    theta = np.radians(best["theta_deg"] + 180)
    page.page.get_by_label("paints what the robot can reach").check()
    drag(-0.6 * radius * np.cos(theta), 0.6 * radius * np.sin(theta))
    count = int(page.facts().split("In reach")[1].split()[0])
    assert 20 < count < 380
    reachable = page.shown_json()
    assert reachable != best and reachable["score"] <= best["score"]
    if reachable["phi_deg"] < 70:
        assert np.cos(np.radians(reachable["theta_deg"]) - theta) > 0
    # The region outlasts another prediction.
    page.page.set_input_files("#image-file", files / "top.jpg")
    page.page.wait_for_timeout(500)
    assert int(page.facts().split("In reach")[1].split()[0]) == count
    page.page.get_by_label("erases it").check()
    drag(-0.6 * radius * np.cos(theta), 0.6 * radius * np.sin(theta))
    assert "\n0 of 400 candidates" in page.facts() and "no candidate is in the region" in page.facts()
    page.page.locator("#reset-region").click()
    assert "400 of 400 candidates" in page.facts()
    page.check_manners()


def test_half_sphere_is_used_by_keyboard(serve, browser, files):
    page = Page(browser, serve("axis").address)
    page.choose(files / "top.png")
    picture = "document.getElementById('sphere').toDataURL()"
    page.page.locator("#sphere").focus()
    before = page.page.evaluate(picture)
    page.page.keyboard.press("ArrowLeft")
    turned = page.page.evaluate(picture)
    assert turned != before
    page.page.keyboard.press("Home")
    assert page.page.evaluate(picture) not in (before, turned)
    page.page.keyboard.press("p")
    page.page.keyboard.press("Space")
    first = int(page.facts().split("In reach")[1].split()[0])
    assert 0 < first < 400
    for _ in range(6):
        page.page.keyboard.press("ArrowRight")
    page.page.keyboard.press("Space")
    both = int(page.facts().split("In reach")[1].split()[0])
    assert first < both < 400
    page.page.keyboard.press("e")
    page.page.keyboard.press("Space")
    assert int(page.facts().split("In reach")[1].split()[0]) < both
    page.page.keyboard.press("Tab")
    assert page.page.evaluate("document.activeElement.id") != "sphere"
    page.check_manners()


def test_camera_takes_the_top_image(serve, browser):
    page = Page(browser, serve("small").address, width=390)
    page.page.get_by_role("button", name="Use the camera").click()
    page.page.get_by_role("button", name="Take the picture").wait_for()
    assert page.violations() == [] and page.overflow() <= 0
    page.page.get_by_role("button", name="Take the picture").click()
    page.page.locator("#results").wait_for(state="visible")
    assert page.page.locator("#camera-panel").is_hidden()
    assert page.page.evaluate("document.images[0].naturalWidth") > 100
    page.check_manners()


def test_dropped_file_is_the_top_image(serve, browser, files):
    page = Page(browser, serve("axis").address)
    data = list((files / "top.png").read_bytes())
    transfer = page.page.evaluate_handle("""data => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([new Uint8Array(data)], "top.png", {type: "image/png"}));
        return transfer;
    }""", data)
    page.page.dispatch_event("#drop", "drop", {"dataTransfer": transfer})
    page.page.locator("#results").wait_for(state="visible")
    page.check_manners()


def test_page_shows_the_servers_own_errors(serve, browser, files):
    page = Page(browser, serve("axis").address)
    page.page.set_input_files("#image-file", files / "depth.npy")
    page.page.locator("#error").wait_for(state="visible")
    page.page.wait_for_timeout(300)
    assert page.page.locator("#error").inner_text() != ""
    assert page.page.locator("#results").is_hidden()
    assert page.violations() == []
    page.context.close()


def test_page_asks_for_the_token(serve, browser, files):
    (files / "token").write_text(TOKEN + "\n")
    page = Page(browser, serve("axis", "--token-file", files / "token").address)
    page.page.locator("#token-form").wait_for(state="visible")
    page.page.fill("#token", TOKEN)
    page.page.get_by_role("button", name="Use it").click()
    page.page.locator("#token-form").wait_for(state="hidden")
    page.choose(files / "top.png")
    assert page.page.locator("#error").is_hidden()
    page.context.close()


def test_page_is_valid(serve):
    if shutil.which("tidy") is None:
        pytest.skip("there is no tidy here; on Debian: apt-get install tidy")
    status, html = serve("axis").ask("GET", "/")
    checked = subprocess.run(["tidy", "-quiet", "-errors"], input=html, capture_output=True)
    assert status == 200 and checked.stderr == b"" and checked.returncode == 0


def test_description_is_valid_and_true(serve, files):
    validator = pytest.importorskip("openapi_spec_validator")
    jsonschema = pytest.importorskip("jsonschema")
    server = serve("depth")
    description = json.loads(server.ask("GET", "/openapi.json")[1])
    validator.validate(description)

    def check(name, value):
        schema = {**description["components"]["schemas"][name], "components": description["components"]}
        jsonschema.validate(value, schema)
        assert set(value) == set(description["components"]["schemas"][name]["properties"])

    check("Model", json.loads(server.ask("GET", "/v1/model")[1]))
    check("CameraPose", json.loads(server.ask("GET", "/v1/camera-pose?theta_deg=30&phi_deg=60&frame=paper")[1]))
    status, body = server.ask("POST", "/v1/predict?grid=even&count=9", *form(files))
    assert status == 200
    check("Prediction", json.loads(body))
    check("View", json.loads(body)["views"][0])
    # Every field of the description is known to the server, and every path is there.
    operation = description["paths"]["/v1/predict"]["post"]
    for parameter in operation["parameters"]:
        if parameter["name"] in ("count", "lowest_phi_deg"):
            continue  # of grid=even only
        value = parameter["schema"].get("default", parameter["schema"].get("examples", [""])[0])
        status, body = server.ask("POST", f"/v1/predict?{parameter['name']}={value}", *form(files))
        assert status == 200, (parameter["name"], body)
    for path, methods in description["paths"].items():
        assert server.ask("GET", path)[0] == (200 if "get" in methods else 405)
