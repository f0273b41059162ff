// svnet-serve: a page and an HTTP interface that score camera poses for top images.
#include <iostream>

#include "command/browser.h"
#include "command/command.h"
#include "command/interrupt.h"
#include "io/models/model_file.h"
#include "serve/guard.h"
#include "serve/listener.h"
#include "serve/routes.h"
#include "serve/server.h"
#include "serve/token.h"

namespace {

using namespace svnet;
using namespace svnet::command;
namespace fs = std::filesystem;

constexpr Index kMebibyte = Index{1} << 20;

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-serve",
                  "Serves a trained model: a page to try it with a browser (drop a top image, turn the half-sphere of "
                  "scores, paint the region that the robot reaches), and a REST interface for programs (POST "
                  "/v1/predict; /openapi.json describes it). It works without a network and stores nothing. Prints its "
                  "address, and runs until Ctrl-C or SIGTERM. Only this machine reaches it, unless --host says "
                  "otherwise, and then a token is required. docs/serve.md has more.",
                  "svnet-serve runs/demo/model.safetensors --open\n"
                  "curl -H 'Content-Type: image/png' --data-binary @top.png http://127.0.0.1:8080/v1/predict\n"
                  "curl -F image=@top.png -F depth=@depth.png 'http://127.0.0.1:8080/v1/predict?grid=even&count=200'");
  serve::Limits limits;
  fs::path model_file, token_file;
  std::string host = "127.0.0.1";
  Index port = 8080, most_megabytes = static_cast<Index>(limits.body_bytes) / kMebibyte;
  bool open = false;
  command.add("MODEL", model_file, "A model that svnet-train wrote (model.safetensors)").required();
  command.add("--port", port, "The TCP port; 0: any that is free").in_range(0, 65535).shows_default();
  command.add("--host", host, "The name or address to listen on; 0.0.0.0: all networks of this machine")
      .value_name("ADDRESS")
      .shows_default();
  command
      .add("--token-file", token_file,
           "A file with a token of 16 characters or more, which clients must send (Authorization: Bearer TOKEN)")
      .value_name("FILE");
  command.add("--max-upload", most_megabytes, "The largest body of a request, in MiB")
      .in_range(1, 1024)
      .value_name("MB")
      .shows_default();
  command
      .add("--timeout", limits.seconds,
           "The time that a request may take to come, to wait for its turn, and its answer to go, in seconds")
      .in_interval(0.1, 3600)
      .value_name("SECONDS")
      .shows_default();
  command
      .add("--parallel", limits.parallel,
           "Predictions at the same time; up to 64 more wait, others are told to try again")
      .in_range(1, 64)
      .shows_default();
  command.add_flag("--open", open, "Shows the page in a browser");
  return command.run(argc, argv, [&](Console& console) {
    limits.body_bytes = static_cast<std::size_t>(most_megabytes * kMebibyte);
    limits.header_seconds = std::min(limits.header_seconds, limits.seconds);
    const bool is_private = serve::is_loopback(host);
    if (!is_private && token_file.empty())
      wrong_usage("--host ", host, " lets other machines in; give a token that they must send by --token-file");
    serve::Guard guard;
    if (!token_file.empty()) guard.token = serve::read_token(token_file);
    if (guard.token.empty()) guard.hosts = serve::loopback_hosts(host);
    serve::Routes routes(io::read_model(model_file), inference_options_from_environment(), limits, std::move(guard));
    const serve::Listener listener(host, port);
    console.result(listener.address());
    std::cout.flush();
    if (open) show_address_in_browser(listener.address(), console);
    serve::serve(
        listener, limits, [&](const serve::Request& request) { return routes.answer(request); }, throw_if_interrupted);
  });
}
