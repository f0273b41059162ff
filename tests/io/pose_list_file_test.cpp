#include "io/views/pose_list_file.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::view;

TEST_CASE("poses are read from CSV") {
  const TemporaryFolder folder;
  const auto path = folder.write("poses.csv", "theta,phi\r\n0,45\r\n\r\n -22.5 ,\t6e1\r\n720,90");
  CHECK(read_pose_list(path) == std::vector<CameraPose>{{0, 45}, {-22.5, 60}, {720, 90}});
}

TEST_CASE("a pose list may begin with a byte order mark") {
  const TemporaryFolder folder;
  CHECK(read_pose_list(folder.write("poses.csv", "\xef\xbb\xbftheta,phi\r\n0,45\r\n")) ==
        std::vector<CameraPose>{{0, 45}});
  CHECK_THROWS(read_pose_list(folder.write("poses.csv",
                                           "theta,phi\n\xef\xbb\xbf"
                                           "0,45\n")));
}

TEST_CASE("a pose list in UTF-16, as spreadsheets save \"Unicode text\", is named") {
  const TemporaryFolder folder;
  for (const std::string& text :
       {std::string("\xff\xfet\0h\0e\0t\0a\0", 12), std::string("\xfe\xff\0t\0h\0e\0t\0a", 12)}) {
    const auto path = folder.write("poses.csv", text);
    CHECK_THROWS_WITH(read_pose_list(path), path.string() + ": is text in UTF-16; save it as UTF-8");
  }
}

TEST_CASE("a pose list may have further columns, as svnet-views writes them") {
  const TemporaryFolder folder;
  CHECK(read_pose_list(folder.write("poses.csv", "theta,phi,x_m,name\n0,45,1.5,first\n90,60,,\n")) ==
        std::vector<CameraPose>{{0, 45}, {90, 60}});
}

TEST_CASE("a pose list is CSV as RFC 4180 has it") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& contents) { return read_pose_list(folder.write("poses.csv", contents)); };
  const std::vector<CameraPose> expected{{0, 45}, {90, 60}};
  CHECK(read("\"theta\",\"phi\"\n0,45\n90,60\n") == expected);
  CHECK(read("\xef\xbb\xbf\"theta\",\"phi\"\r\n\"0\",\"45\"\r\n\"90\" , \"60\"\r\n") == expected);
  CHECK(read("theta,phi,note\n0,45,\"a, \"\"quoted\"\" word\"\n90,60,\"two\r\nlines\"\n") == expected);
  CHECK(read("theta,phi\r0,45\r90,60\r") == expected);
  CHECK(read("theta,phi\n+0,+45\n\"+90\",+6.0e1\n") == expected);
  const auto message = [&](const std::string& contents) -> std::string {
    try {
      read(contents);
    } catch (const Error& error) {
      return std::string(error.what()).substr((folder.path() / "poses.csv").string().size());
    }
    return "read";
  };
  CHECK(message("theta,phi\n0,\"45\n") == ":2: a quote is not closed");
  CHECK(message("theta,phi\n0,\"45\"6\n") == ":2: text after a closing quote; double the quotes inside a field");
  CHECK(message("theta,phi,n\n0,45,\"a\nb\"\n0,95,c\n") == ":4: phi 95 is outside [0, 90] degrees");
  for (const char* number : {"++4", "+-4", "+", "4+"})
    CHECK_THAT(message(joined("theta,phi\n0,", number, "\n")), Catch::Contains("does not begin with two numbers"));
}

TEST_CASE("angles that are out of range by rounding alone are taken for the bound, others are printed in full") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& row) {
    return read_pose_list(folder.write("poses.csv", "theta,phi\n" + row + "\n")).at(0);
  };
  CHECK(read("0,90.00000250447816") == CameraPose{0, 90});
  CHECK(read("0,90.0001") == CameraPose{0, 90});
  CHECK(read("-360.00009,-0.00009") == CameraPose{-360, 0});
  CHECK(read("720.00005,45") == CameraPose{720, 45});
  CHECK_THROWS_WITH(read("0,90.00011"), Catch::EndsWith(":2: phi 90.00011 is outside [0, 90] degrees"));
  CHECK_THROWS_WITH(read("0,-0.0002"), Catch::EndsWith(":2: phi -0.0002 is outside [0, 90] degrees"));
}

TEST_CASE("a wrong pose list is refused with file and line") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& contents) {
    const auto path = folder.write("poses.csv", contents);
    try {
      read_pose_list(path);
    } catch (const Error& error) {
      const std::string text = error.what();
      REQUIRE(text.rfind(path.string(), 0) == 0);
      return text.substr(path.string().size());
    }
    return std::string("accepted");
  };
  const std::string not_two = "' does not begin with two numbers, theta and phi in degrees";
  CHECK(message("phi,theta\n45,0\n") == ":1: the header is 'phi,theta', expected 'theta,phi'");
  CHECK(message("theta\n0\n") == ":1: the header is 'theta', expected 'theta,phi'");
  CHECK(message("theta,psi\n0,45\n") == ":1: the header is 'theta,psi', expected 'theta,phi'");
  CHECK(message("theta,phi\n0,45,") == ":2: '0,45,' has 3 columns, the header 2");
  CHECK(message("\n0,45\n") == ":2: the header is '0,45', expected 'theta,phi'");
  CHECK(message("theta,phi\n0,45\n0 45\n") == ":3: '0 45' has 1 columns, the header 2");
  CHECK(message("theta,phi\n0,45,1\n") == ":2: '0,45,1' has 3 columns, the header 2");
  CHECK(message("theta,phi,x_m\n0,45\n") == ":2: '0,45' has 2 columns, the header 3");
  CHECK(message("theta,phi\n0,\n") == ":2: '0," + not_two);
  CHECK(message("theta,phi\n0,4\x1b"
                "5\n") == ":2: '0,4?5" + not_two);
  CHECK(message("theta,phi\n\n0,95\n") == ":3: phi 95 is outside [0, 90] degrees");
  CHECK(message("theta,phi\nnan,45\n") == ":2: theta nan is not finite");
  CHECK(message("theta,phi\n") == ": holds no pose; expected the header 'theta,phi' and a line for each pose");
  CHECK(message("") == ": holds no pose; expected the header 'theta,phi' and a line for each pose");
  CHECK_THROWS_WITH(read_pose_list(folder.path() / "none.csv"), Catch::EndsWith("none.csv: cannot be read; expected a "
                                                                                "CSV file of poses"));
  CHECK_THROWS_WITH(read_pose_list(folder.path()), Catch::Contains(": cannot be read"));
}
