// What the commands print without a terminal: plain lines, no control characters.
#include <algorithm>
#include <catch2/catch.hpp>

#include "workplace.h"

using namespace svnet;

namespace {

void check_plain(const Workplace& place, const std::string& command, int status = 0) {
  INFO(command);
  const Ran ran = place.run("export TERM=xterm-256color; " + command);
  INFO(ran.err);
  CHECK(ran.status == status);
  const std::string all = ran.out + ran.err;
  CHECK_FALSE(all.empty());
  CHECK(std::none_of(all.begin(), all.end(), [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }));
  CHECK(all.back() == '\n');
}

}  // namespace

TEST_CASE("redirected output of every command is plain lines") {
  const Workplace place;
  for (const std::string program : {"svnet-train", "svnet-eval", "svnet-features", "svnet-score", "svnet-predict",
                                    "svnet-info", "svnet-pretrain", "svnet-render", "svnet-sort"}) {
    check_plain(place, program + " --help");
    check_plain(place, program + " --version");
    check_plain(place, program + " --colour", 2);
    CHECK_THAT(place.output_of(program + " --help"), Catch::Contains("\nExample:\n  " + program + " "));
  }
  for (const char* command :
       {"svnet-train config.yaml --dry-run",
        "svnet-train config.yaml --output run",
        "svnet-train config.yaml --output run",
        "svnet-train config.yaml --output run --resume never",
        "svnet-eval run --json tables.json",
        "svnet-features --backbone tiny_xception --weights weights/tiny_xception.h5 --images data --output again.h5",
        "svnet-score --dataset data --features features.h5 "
        "--output again.h5 --problems 300",
        "svnet-predict model.safetensors --image top.png --plot plot.png",
        "svnet-predict model.safetensors --image top.png --json",
        "svnet-sort data --sheet sheet.png --dendrogram tree.png",
        "svnet-sort data --json -",
        "svnet-info",
        "svnet-info features.h5",
        "svnet-info scores.h5",
        "svnet-info model.safetensors",
        "svnet-info run/checkpoint-last.safetensors",
        "svnet-info weights/tiny_xception.h5",
        "svnet-render --output mugs --categories mug --objects 1 --poses 1 --size 32",
        "svnet-pretrain --images data --output tiny_xception.safetensors --epochs 1",
        "svnet-info tiny_xception.safetensors",
        "svnet-features --backbone tiny_xception --images data --output built-in.h5",
        "svnet-features --backbone tiny_xception --weights tiny_xception.safetensors --images data --output again.h5"})
    check_plain(place, command);
}

TEST_CASE("control characters of names do not reach the output") {
  const Workplace place;
  check_plain(place, "svnet-sort \"$(printf 'a\\033[31m\\rb.png')\"", 1);
  check_plain(place, "cp top.png \"$(printf 'c\\033[31m.png')\" && svnet-sort c*.png top.png");
  check_plain(place, "svnet-predict model.safetensors --image \"$(printf 'a\\033[31m\\rb.png')\"", 1);
  check_plain(place, "svnet-info \"$(printf 'a\\033[31m\\b')\"", 1);
  check_plain(place, "svnet-info \"$(printf -- '--\\033[31m')\"", 2);
  check_plain(
      place,
      "cp -r data \"$(printf 'd\\033[1m')\" && svnet-train config.yaml --output run --set dataset.root=\"$(printf "
      "'d\\033[1m')\"");
  check_plain(place,
              "cp features.h5 \"$(printf 'f\\033[1m')\" && svnet-score --dataset data --problems 10 --output "
              "\"$(printf 'o\\033[1m')\" --features \"$(printf 'f\\033[1m')\"");
}
