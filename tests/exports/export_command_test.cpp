#include <catch2/catch.hpp>

#include "shell.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
using Catch::Contains;

TEST_CASE("svnet-export says that its exports agree, and refuses what it cannot write") {
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", small_model());
  const auto run = [&](const std::string& options) {
    return run_shell(folder.path(), SVNET_EXPORT " model.safetensors " + options);
  };

  const Ran both = run("--onnx m.onnx --keras keras");
  CHECK(both.status == 0);
  CHECK_THAT(both.out, Contains("m.onnx: agrees with the model on 4 pictures x 20 poses: largest difference") &&
                           Contains("(bound 1e-05), the same best pose in 4 of 4") && Contains("keras: agrees"));
  CHECK(run("--safetensors small.safetensors --precision int8").status == 0);

  const Ran nothing = run("");
  CHECK(nothing.status == 2);
  CHECK_THAT(nothing.err, Contains("nothing to write; give --onnx, --keras or --safetensors"));
  CHECK(run("--keras k --precision bf16").status == 2);
  CHECK(run("--safetensors k --part head").status == 2);
  const Ran itself = run("--onnx model.safetensors");
  CHECK(itself.status == 1);
  CHECK_THAT(itself.err, Contains("model.safetensors"));
  const Ran again = run("--keras keras");
  CHECK(again.status == 1);
  CHECK_THAT(again.err, Contains("keras"));
}
