#include "report/markup.h"

#include <catch2/catch.hpp>
#include <limits>

#include "report/axis.h"
#include "report/base64.h"
#include "report/names.h"

using namespace svnet::report;

TEST_CASE("text is escaped, in contents and in attributes") {
  CHECK(escaped("a < b & \"c\" > 'd'") == "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  CHECK(element("p", {{"title", "\"><script>"}}, escaped("<script>")) ==
        "<p title=\"&quot;&gt;&lt;script&gt;\">&lt;script&gt;</p>");
  CHECK(escaped("tab\tline\nend") == "tab line end");
  CHECK(escaped("Löffel θ 茶 🍵") == "Löffel θ 茶 🍵");
}

TEST_CASE("bytes that are not UTF-8, and control characters, become U+FFFD") {
  const std::string replacement = "\xef\xbf\xbd";
  CHECK(escaped("a\xff"
                "b") == "a" + replacement + "b");
  CHECK(escaped("cut\xe8\x8c") == "cut" + replacement + replacement);
  CHECK(escaped(std::string("\0\x1b\x7f", 3)) == replacement + replacement + replacement);
  CHECK(escaped("\xc2\x85") == replacement);
}

TEST_CASE("numbers have a true minus sign, and none at zero") {
  CHECK(number(0.12345) == "0.123");
  CHECK(number(-0.12345) == "−0.123");
  CHECK(number(-0.0001) == "0.000");
  CHECK(signed_number(0.0609) == "+0.061");
  CHECK(signed_number(0.0001) == "0.000");
  CHECK(number(std::numeric_limits<double>::quiet_NaN()) == "–");
  CHECK(coordinate(-0.001) == "0");
  CHECK(coordinate(12.50) == "12.5");
  CHECK(coordinate(1e6) == "1000000");
}

TEST_CASE("texts are shortened by characters, not bytes") {
  CHECK(shortened("θθθθ", 4) == "θθθθ");
  CHECK(shortened("θθθθθ", 4) == "θθθ…");
}

TEST_CASE("axes have round ticks around the values") {
  const Axis axis = round_axis(-0.052, 0.081, 3, 0, 100);
  CHECK(axis.step == Approx(0.05));
  CHECK(axis.low == Approx(-0.1));
  CHECK(axis.high == Approx(0.1));
  CHECK(axis.place(0) == Approx(50));
  CHECK(axis.tick_text(axis.ticks()[1]) == "−0.05");
  const Axis flat = round_axis(0.5, 0.5, 3, 0, 100);
  CHECK(flat.low < 0.5);
  CHECK(flat.high > 0.5);
  CHECK(round_axis(1e300, -1e300, 3, 0, 100).ticks().size() < 20);
}

TEST_CASE("base64 is that of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe") == "//4=");
}

TEST_CASE("ids are unique and safe in links") {
  Ids ids;
  CHECK(ids.make("mug-3") == "mug-3");
  CHECK(ids.make("mug-3") == "mug-3-2");
  CHECK(ids.make("spray bottle/\"1\"") == "spray-bottle--1-");
  CHECK(ids.make("3d-1") == "o3d-1");
  CHECK(ids.make("café-1") == "café-1");
}
