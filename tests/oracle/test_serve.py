"""svnet-serve: its page in a browser, what axe and tidy say of it, its description, and its manners under load.

Chromium (Debian: chromium) and tidy are used if they are installed; otherwise these tests skip.
"""
import concurrent.futures
import http.client
import json
import os
import pathlib
import random
import shutil
import socket
import statistics
import subprocess
import threading
import time
import zlib

import numpy as np
import pytest

BUILD = pathlib.Path(os.environ["SVNET_BUILD"])
TOKEN = "a-token-of-the-tests-0123456789"


class Server:
    """svnet-serve on a free port."""

    def __init__(self, model, *options):
        self.process = subprocess.Popen([BUILD / "bin/svnet-serve", model, "--port", "0", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:")
        self.port = int(self.address.rsplit(":", 1)[1])

    def stop(self):
        self.process.terminate()
        return self.process.wait(timeout=20)

    def memory_mb(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) / 1024

    def ask(self, method, path, body=None, headers=None):
        """Returns status and body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.read()
        finally:
            connection.close()

    def talk(self, *pieces, pause=0.0):
        """Sends pieces of bytes with pauses, and returns all that comes back."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            answer = b""
            try:
                for piece in pieces:
                    connection.sendall(piece)
                    time.sleep(pause)
                while received := connection.recv(65536):
                    answer += received
            except (BrokenPipeError, ConnectionResetError):
                pass
            return answer


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    """Paths of a top image and its depth."""
    from PIL import Image

    folder = tmp_path_factory.mktemp("serve")
    noise = np.random.default_rng(7)
    y, x = np.mgrid[-1:1:96j, -1:1:128j]
    bar = (np.abs(x + 0.1) < 0.55) & (np.abs(y) < 0.1 + 0.12 * (x > 0.2))
    image = np.where(bar[..., None], [150, 60, 50], [170, 165, 155]) + noise.normal(0, 3, (96, 128, 3))
    Image.fromarray(np.clip(image, 0, 255).astype(np.uint8)).save(folder / "top.png")
    Image.fromarray(np.clip(image, 0, 255).astype(np.uint8)).save(folder / "top.jpg")
    np.save(folder / "depth.npy", np.where(bar, 0.47, 0.5).astype(np.float32))
    return folder


@pytest.fixture
def serve():
    """serve(model, *options): a Server that ends with the test."""
    servers = []

    def start(model, *options):
        servers.append(Server(BUILD / "tests" / f"{model}_model.safetensors", *options))
        return servers[-1]

    yield start
    for server in servers:
        server.stop()


@pytest.fixture(scope="module")
def chromium():
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


class Page:
    """The page of a server, with what it complains of and asks for."""

    def __init__(self, chromium, address, width=1280, scheme="light"):
        self.context = chromium.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme,
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
def test_page_in_a_browser(serve, chromium, files, width, scheme):
    page = Page(chromium, serve("depth").address, width, scheme)
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


def test_page_shows_what_the_interface_answers(serve, chromium, files):
    server = serve("axis")
    page = Page(chromium, server.address)
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


def test_region_is_painted_erased_and_reset(serve, chromium, files):
    page = Page(chromium, serve("axis").address)
    page.choose(files / "top.png")
    assert "400 of 400 candidates" in page.facts()
    best = page.shown_json()
    page.page.locator("#from-above").click()
    sphere = page.page.locator("#sphere")
    sphere.scroll_into_view_if_needed()
    box = sphere.bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    radius = 0.41 * box["width"]

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


def test_half_sphere_is_used_by_keyboard(serve, chromium, files):
    page = Page(chromium, serve("axis").address)
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


def test_camera_takes_the_top_image(serve, chromium):
    page = Page(chromium, serve("small").address, width=390)
    page.page.get_by_role("button", name="Use the camera").click()
    page.page.get_by_role("button", name="Take the picture").wait_for()
    assert page.violations() == [] and page.overflow() <= 0
    page.page.get_by_role("button", name="Take the picture").click()
    page.page.locator("#results").wait_for(state="visible")
    assert page.page.locator("#camera-panel").is_hidden()
    assert page.page.evaluate("document.images[0].naturalWidth") > 100
    page.check_manners()


def test_dropped_file_is_the_top_image(serve, chromium, files):
    page = Page(chromium, serve("axis").address)
    data = list((files / "top.png").read_bytes())
    transfer = page.page.evaluate_handle("""data => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([new Uint8Array(data)], "top.png", {type: "image/png"}));
        return transfer;
    }""", data)
    page.page.dispatch_event("#drop", "drop", {"dataTransfer": transfer})
    page.page.locator("#results").wait_for(state="visible")
    page.check_manners()


def test_page_shows_the_servers_own_errors(serve, chromium, files):
    page = Page(chromium, serve("axis").address)
    page.page.set_input_files("#image-file", files / "depth.npy")
    page.page.locator("#error").wait_for(state="visible")
    page.page.wait_for_timeout(300)
    assert page.page.locator("#error").inner_text() != ""
    assert page.page.locator("#results").is_hidden()
    assert page.violations() == []
    page.context.close()


def test_page_asks_for_the_token(serve, chromium, files):
    (files / "token").write_text(TOKEN + "\n")
    page = Page(chromium, serve("axis", "--token-file", files / "token").address)
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


def form(files):
    """Body and headers of a form with the top image and its depth."""
    body = b""
    for name, file in [("image", "top.png"), ("depth", "depth.npy")]:
        body += b'--XX\r\nContent-Disposition: form-data; name="%s"; filename="x"\r\n\r\n' % name.encode()
        body += (files / file).read_bytes() + b"\r\n"
    return body + b"--XX--\r\n", {"Content-Type": "multipart/form-data; boundary=XX"}


def black_png(width, height):
    """A PNG file of black pixels, small however large the image is."""
    def chunk(kind, data):
        return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")

    packer = zlib.compressobj(9)
    row = bytes(1 + 3 * width)
    rows = b"".join(packer.compress(row) for _ in range(height)) + packer.flush()
    header = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def test_server_full_of_idle_connections(serve):
    """Connections that say nothing take all places, until they are closed or time is up."""
    server = serve("axis", "--timeout", "3")
    idle = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(128)]
    time.sleep(0.3)
    refused = server.talk(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
    assert refused.startswith(b"HTTP/1.1 503 ") and b'{"error":' in refused
    for connection in idle[:10]:
        connection.close()
    time.sleep(0.3)
    assert server.ask("GET", "/healthz")[0] == 200
    time.sleep(3)
    assert all(connection.recv(1000) == b"" for connection in idle[10:])
    for connection in idle[10:]:
        connection.close()


def test_server_under_load(serve, files, report):
    """2,000 requests, 50 at a time, good and bad ones mixed: every one is answered with its status."""
    server = serve("depth", "--timeout", "2", "--max-upload", "4")
    body, headers = form(files)
    png = (files / "top.png").read_bytes()
    head = b"POST /v1/predict HTTP/1.1\r\nHost: localhost\r\nContent-Type: %s\r\nContent-Length: %d\r\n\r\n"
    png_head = head % (b"image/png", len(png))
    form_head = head % (headers["Content-Type"].encode(), len(body))
    bomb = body.replace(png, black_png(9000, 9000))
    wide = body.replace(png, black_png(6000, 4000))

    def status_of(answer):
        return int(answer[9:12]) if answer.startswith(b"HTTP/1.1 ") else 0

    def post(data, more=headers):
        return lambda: server.ask("POST", "/v1/predict", data, more)[0]

    def sent(*pieces, pause=0.0):
        return lambda: status_of(server.talk(*pieces, pause=pause))

    # (share, statuses that are right besides 503, request)
    kinds = {
        "valid": (120, {200}, post(body)),
        "page": (20, {200}, lambda: server.ask("GET", "/")[0]),
        "without depth": (8, {422}, post(png, {"Content-Type": "image/png"})),
        "large image": (1, {200, 422}, post(wide)),
        "81 megapixels": (4, {422}, post(bomb)),
        "damaged image": (8, {422}, post(body.replace(png, png[:-200] + bytes(200)))),
        "cut form": (8, {400}, post(body[:-40])),
        "unknown field": (4, {400}, lambda: server.ask("POST", "/v1/predict?x=1", body, headers)[0]),
        "another format": (4, {415}, post(b"GIF89a" + bytes(100), {"Content-Type": "image/gif"})),
        "too large": (2, {413}, post(bytes(5 << 20))),
        "announced too large": (4, {413}, sent(head % (b"image/png", 10**12))),
        "ends early": (4, {400, 0}, lambda: hang_up(form_head + body[:1000])),
        "slow body": (1, {408}, sent(png_head, png[:10], pause=1.5)),
        "slow header": (1, {408}, sent(b"GET / HTTP/1.1\r\n", b"Host: localhost\r\n", pause=1.5)),
        "garbage": (4, {400}, sent(random.Random(1).randbytes(3000) + b"\r\n\r\n")),
        "long header": (4, {431}, sent(b"GET / HTTP/1.1\r\n" + b"A: bcdefgh\r\n" * 4000)),
        "other host": (3, {421}, lambda: server.ask("GET", "/", headers={"Host": "evil.example"})[0]),
    }

    def hang_up(data):
        with socket.create_connection(("127.0.0.1", server.port)) as connection:
            connection.sendall(data)
        return 0

    total = sum(share for share, _, _ in kinds.values())
    names = [name for name, (share, _, _) in kinds.items() for _ in range(share * 2000 // total)]
    names += ["valid"] * (2000 - len(names))
    random.Random(5).shuffle(names)
    for _ in range(20):
        kinds["valid"][2]()
    before, peak, running = server.memory_mb(), 0.0, True

    def watch():
        nonlocal peak
        while running:
            peak = max(peak, server.memory_mb())
            time.sleep(0.02)

    watcher = threading.Thread(target=watch)
    watcher.start()
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(50) as pool:
        statuses = list(pool.map(lambda name: kinds[name][2](), names))
    seconds = time.monotonic() - begin
    running = False
    watcher.join()
    wrong = {(name, status) for name, status in zip(names, statuses) if status not in kinds[name][1] | {503}}
    assert wrong == set()
    assert server.process.poll() is None
    counts = {status: statuses.count(status) for status in sorted(set(statuses))}
    answered = statistics.mean(status == 200 for name, status in zip(names, statuses) if name == "page")
    assert answered > 0.95  # being busy with predictions does not keep the page away
    assert counts[200] > 300

    time.sleep(3)  # threads that still wait for slow clients
    after = server.memory_mb()
    report(f"svnet-serve: 2000 requests, 50 at a time, {seconds:.1f} s, statuses {counts}, "
           f"memory {before:.0f} MB before, {peak:.0f} MB at most, {after:.0f} MB after")
    # Two images of 24 megapixels and all that is made of them, and bodies of 4 MiB.
    assert peak < before + 1200
    assert after < before + 150

    times = []

    def client(_):
        for _ in range(100):
            start = time.monotonic()
            assert kinds["valid"][2]() == 200
            times.append(time.monotonic() - start)

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        list(pool.map(client, range(4)))
    times.sort()
    median, p99 = times[len(times) // 2], times[int(0.99 * len(times))]
    report(f"svnet-serve: 4 clients, 400 valid requests: median {1e3 * median:.1f} ms, p99 {1e3 * p99:.1f} ms "
           f"({p99 / median:.1f} times the median)")
    assert server.stop() == 130
