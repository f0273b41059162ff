// svnet-serve as a process: its options, its address, requests over TCP, and its end.
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frame/top_view.h"
#include "io/images/image_codecs.h"
#include "io/models/model_file.h"
#include "shell.h"
#include "small_model.h"

using namespace svnet;

extern char** environ;

namespace {

/// svnet-serve on a free port of this machine, while the object exists.
class Server {
 public:
  explicit Server(std::vector<std::string> more = {}) {
    const std::string model = folder_.path() / "model.safetensors", out = folder_.path() / "out";
    io::write_model(model, small_axis_model());
    std::vector<std::string> words{SVNET_SERVE, model, "--port", "0"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    REQUIRE(::posix_spawn(&process_, SVNET_SERVE, &files, nullptr, arguments.data(), environ) == 0);
    posix_spawn_file_actions_destroy(&files);
    for (int i = 0; i < 1000 && !contents_so_far(out).ends_with('\n'); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    address_ = file_contents(out);
    REQUIRE_THAT(address_, Catch::StartsWith("http://127.0.0.1:"));
    port_ = std::stoi(address_.substr(address_.rfind(':') + 1));
  }
  ~Server() {
    if (process_ > 0) stop(SIGKILL);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Sends bytes and returns all that comes back. Does not end the sending side.
  std::string talk(const std::string& bytes) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port_));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0);
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t size = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (size <= 0) break;
      sent += static_cast<std::size_t>(size);
    }
    std::string answer;
    std::array<char, 4096> buffer{};
    for (ssize_t got; (got = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0;)
      answer.append(buffer.data(), static_cast<std::size_t>(got));
    ::close(socket);
    return answer;
  }

  std::string post(const std::string& body, const std::string& more = "") const {
    return talk("POST /v1/predict HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\nContent-Length: " +
                std::to_string(body.size()) + "\r\n" + more + "\r\n" + body);
  }

  int port() const { return port_; }

  /// Sends a signal and returns the exit status.
  int stop(int signal) {
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  static std::string contents_so_far(const std::filesystem::path& path) {
    return std::filesystem::exists(path) ? file_contents(path) : "";
  }

  TemporaryFolder folder_;
  pid_t process_ = 0;
  std::string address_;
  int port_ = 0;
};

std::string top_png() { return io::encoded_png("top", frame::picture_of(frame::letter_t(1.2, 33), {.noise = 3})); }

}  // namespace

TEST_CASE("svnet-serve answers until it is told to end") {
  const int signal = GENERATE(SIGINT, SIGTERM);
  Server server;
  const std::string health = server.talk("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  CHECK_THAT(health, Catch::StartsWith("HTTP/1.1 200 OK\r\n"));
  for (const char* header : {"Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff",
                             "frame-ancestors 'none'", "Connection: close", "Content-Type: application/json"})
    CHECK_THAT(health, Catch::Contains(header));
  CHECK_THAT(health, !Catch::Contains("Access-Control"));
  CHECK_THAT(health, !Catch::Contains("unsafe-inline"));
  const std::string answer = server.post(top_png());
  REQUIRE_THAT(answer, Catch::StartsWith("HTTP/1.1 200 OK\r\n"));
  CHECK(nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n"))).at("views").size() == 22);
  CHECK(server.stop(signal) == 130);
}

TEST_CASE("svnet-serve ends while a client is slow") {
  Server server;
  std::string answer;
  std::thread slow(
      [&] { answer = server.talk("POST /v1/predict HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\n1"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto begin = std::chrono::steady_clock::now();
  CHECK(server.stop(SIGTERM) == 130);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
  slow.join();
}

TEST_CASE("svnet-serve waits for the body of a client that asks first") {
  const Server server;
  const std::string answer = server.post(top_png(), "Expect: 100-continue\r\n");
  CHECK_THAT(answer, Catch::StartsWith("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\n"));
  CHECK_THAT(
      server.talk("POST /v1/predict HTTP/1.1\r\nHost: evil\r\nContent-Length: 9\r\nExpect: 100-continue\r\n\r\n"),
      Catch::StartsWith("HTTP/1.1 421 "));
}

TEST_CASE("svnet-serve survives what is no request") {
  const Server server({"--timeout", "1", "--max-upload", "1"});
  const std::string host = "Host: localhost\r\n";
  const auto status_of = [&](const std::string& bytes) {
    const std::string answer = server.talk(bytes);
    CAPTURE(bytes.substr(0, 100), answer.substr(0, 200));
    const auto body =
        nlohmann::json::parse(answer.substr(std::min(answer.find("\r\n\r\n"), answer.size())), nullptr, false);
    CHECK((body.is_object() && body.at("error").is_string()));
    return answer.substr(0, 12);
  };
  CHECK(status_of("garbage\r\n\r\n") == "HTTP/1.1 400");
  CHECK(status_of("GET / HTTP/9.9\r\n" + host + "\r\n") == "HTTP/1.1 400");
  CHECK(status_of("GET / HTTP/1.1\r\n\r\n") == "HTTP/1.1 400");
  CHECK(status_of("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n" + host + "\r\n") == "HTTP/1.1 414");
  CHECK(status_of("GET /" + std::string(100'000, 'a')) == "HTTP/1.1 431");
  CHECK(status_of("GET / HTTP/1.1\r\n" + std::string(40'000, 'a')) == "HTTP/1.1 431");
  CHECK(status_of("GET / HTTP/1.1\r\nHo") == "HTTP/1.1 408");
  CHECK(status_of("POST /v1/predict HTTP/1.1\r\n" + host + "Content-Length: 100\r\n\r\nabc") == "HTTP/1.1 408");
  CHECK(status_of("POST /v1/predict HTTP/1.1\r\n" + host + "Content-Length: 2000000\r\n\r\n" +
                  std::string(2'000'000, 'a')) == "HTTP/1.1 413");
  CHECK(status_of("POST /v1/predict HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n") ==
        "HTTP/1.1 411");
  CHECK(status_of("OPTIONS /v1/predict HTTP/1.1\r\n" + host + "\r\n") == "HTTP/1.1 405");
  std::string ranges = "bytes=";
  for (int i = 0; i < 1900; ++i) ranges += "0-1,";
  const std::string ranged = server.talk("GET / HTTP/1.1\r\n" + host + "Range: " + ranges + "0-1\r\n\r\n");
  CHECK_THAT(ranged, Catch::StartsWith("HTTP/1.1 200 OK"));
  CHECK_THAT(server.talk("GET /healthz HTTP/1.1\r\n" + host + "\r\n"), Catch::StartsWith("HTTP/1.1 200 OK"));
}

TEST_CASE("svnet-serve asks for its token") {
  const TemporaryFolder folder;
  const std::string file = folder.write("token", "0123456789abcdef\n");
  const Server server({"--token-file", file});
  const std::string request = "GET /v1/model HTTP/1.1\r\nHost: localhost\r\n";
  const std::string refused = server.talk(request + "\r\n");
  CHECK_THAT(refused, Catch::StartsWith("HTTP/1.1 401 "));
  CHECK_THAT(refused, Catch::Contains("WWW-Authenticate: Bearer"));
  CHECK_THAT(server.talk(request + "Authorization: Bearer 0123456789abcdef\r\n\r\n"),
             Catch::StartsWith("HTTP/1.1 200 "));
  // A proxy passes on the host name that its clients use.
  CHECK_THAT(server.talk("GET /v1/model HTTP/1.1\r\nHost: robot.example\r\nOrigin: https://robot.example\r\n"
                         "Authorization: Bearer 0123456789abcdef\r\n\r\n"),
             Catch::StartsWith("HTTP/1.1 200 "));
}

TEST_CASE("svnet-serve says what is wrong with its arguments") {
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", small_axis_model());
  const auto run = [&](const std::string& arguments) { return run_shell(folder.path(), SVNET_SERVE " " + arguments); };
  const Ran open = run("model.safetensors --host 0.0.0.0");
  CHECK(open.status == 2);
  CHECK(open.out.empty());
  CHECK(open.err ==
        "svnet-serve: --host 0.0.0.0 lets other machines in; give a token that they must send by --token-file; see "
        "svnet-serve --help\n");
  CHECK_THAT(run("none").err, Catch::StartsWith("svnet-serve: none: "));
  CHECK(run("model.safetensors --port 70000").status == 2);
  folder.write("short", "abc");
  CHECK_THAT(run("model.safetensors --token-file short").err, Catch::StartsWith("svnet-serve: short: is no token"));
  const Server taken;
  const std::string port = std::to_string(taken.port());
  CHECK(run("model.safetensors --port " + port).err ==
        "svnet-serve: port " + port + " of 127.0.0.1 cannot be used: Address already in use\n");
  CHECK_THAT(run("--help").out, Catch::Contains("/v1/predict"));
}
