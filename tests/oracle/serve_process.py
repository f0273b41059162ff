"""svnet-serve as a process, for test_serve.py and test_serve_load.py."""
import http.client
import os
import pathlib
import socket
import subprocess
import time

import numpy as np
import pytest

BUILD = pathlib.Path(os.environ["SVNET_BUILD"])


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


def form(files):
    """Body and headers of a form with the top image and its depth."""
    body = b""
    for name, file in [("image", "top.png"), ("depth", "depth.npy")]:
        body += b'--XX\r\nContent-Disposition: form-data; name="%s"; filename="x"\r\n\r\n' % name.encode()
        body += (files / file).read_bytes() + b"\r\n"
    return body + b"--XX--\r\n", {"Content-Type": "multipart/form-data; boundary=XX"}
