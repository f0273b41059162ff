#include "train/training_events.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "io/files/whole_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::train;

TEST_CASE("each row of metrics.csv is added once, without the cells that are empty") {
  const TemporaryFolder folder;
  TrainingEvents events(folder.path());
  const auto contents = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) return io::whole_file(entry.path());
    return std::string();
  };
  std::string metrics = "epoch,step,learning_rate,loss,validation_loss,validation_spearman\n1,10,0.1,0.5,,\n";
  events.add(metrics);
  const std::string first = contents();
  CHECK_THAT(first, Catch::Contains("training/loss") && Catch::Contains("training/learning_rate"));
  CHECK_THAT(first, !Catch::Contains("validation"));
  events.add(metrics);
  CHECK(contents() == first);
  metrics += "2,20,0.1,0.4,0.3,0.7\n";
  events.add(metrics);
  CHECK_THAT(contents(), Catch::StartsWith(first));
  CHECK_THAT(contents().substr(first.size()), Catch::Contains("validation/spearman"));
  CHECK_THROWS_WITH(events.add(metrics + "3,30\n"), "[training] metrics.csv, row 3: does not fit the header");
}
