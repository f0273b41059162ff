"""svnet-serve under load: good, damaged, huge, cut and slow requests at the same time."""
import concurrent.futures
import random
import socket
import statistics
import threading
import time
import zlib

from serve_process import files, form, serve  # noqa: F401: fixtures


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
