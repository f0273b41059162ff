#include "serve/field_values.h"

#include "base/exif_orientation.h"
#include "serve/requests.h"

using namespace svnet;
using namespace svnet::serve;

TEST_CASE("fields are taken once, and others are named") {
  FieldValues fields({{"count", "12"}, {"cuont", "3"}, {"exif_orientation", "obey"}});
  CHECK(fields.number("count", 1) == 12);
  CHECK(fields.number("count", 1) == 1);
  CHECK(fields.choice("exif_orientation", ExifOrientation::ignore) == ExifOrientation::obey);
  CHECK(refusal_of([&] { fields.check_all_taken(); }) ==
        "400 the field cuont is not known here, did you mean 'count'?");
}

TEST_CASE("a repeated field, a wrong number and a wrong name are refused") {
  CHECK(refusal_of([] {
          FieldValues(Fields{{"a", "1"}, {"b", "2"}, {"a", "3"}});
        }) == "400 the field a is there twice");
  for (const char* wrong : {"", "x", "1x", " 1", "nan", "inf", "1e999", "1,2"}) {
    FieldValues fields(Fields{{"a", wrong}});
    CAPTURE(wrong);
    CHECK_THAT(refusal_of([&] { fields.number("a", 0); }), Catch::StartsWith("400 a: '"));
  }
  FieldValues fields(Fields{{"exif_orientation", "obay"}});
  CHECK(refusal_of([&] { fields.choice("exif_orientation", ExifOrientation::ignore); }) ==
        "400 exif_orientation: 'obay' is not known, did you mean 'obey'?");
}

TEST_CASE("lists of numbers") {
  CHECK(numbers_in("a", "0.5,-1,2e1") == std::vector<double>{0.5, -1, 20});
  for (const char* wrong : {",", "1,", ",1", "1,,2", "1;2"}) {
    CAPTURE(wrong);
    CHECK_THAT(refusal_of([&] { numbers_in("a", wrong); }), Catch::StartsWith("400 a: "));
  }
}
