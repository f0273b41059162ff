// Requests of HTTP, and the forms in them.
#include "base/error.h"
#include "io/images/image_codecs.h"
#include "seeds.h"
#include "small_model.h"

namespace svnet::fuzz {
namespace {

std::string request(const std::string& line, const std::string& type = "", const std::string& body = "") {
  std::string text = line + " HTTP/1.1\r\nHost: localhost:8080\r\n";
  if (!type.empty()) text += joined("Content-Type: ", type, "\r\nContent-Length: ", body.size(), "\r\n");
  return text + "\r\n" + body;
}

std::string part(const std::string& name, const std::string& contents) {
  return "--XX\r\nContent-Disposition: form-data; name=\"" + name + "\"; filename=\"a;b\"\r\n\r\n" + contents + "\r\n";
}

}  // namespace

void add_requests(const Seeds& seeds) {
  const std::string png = io::encoded_png("seed", small_image(30, 20));
  const std::string fields = part("grid", "even") + part("count", "5") + part("lowest_phi_deg", "30") +
                             part("radius_m", "0.4") + part("centre_m", "0.4,0,0.05") + part("frame", "paper") +
                             part("exif_orientation", "obey") + part("depth_unit", "mm") + "--XX--\r\n";
  const std::string type = "multipart/form-data; boundary=XX";
  seeds.add("http", "predict", request("POST /v1/predict?poses=90,90;0,45", "image/png", png));
  seeds.add("http", "form", request("POST /v1/predict", type, part("image", png) + fields));
  for (const char* path : {"/", "/healthz", "/openapi.json", "/v1/model", "/v1/camera-pose?theta_deg=30&phi_deg=45"})
    seeds.add("http", "get" + std::to_string(std::string(path).size()), request(std::string("GET ") + path));
  seeds.add("http", "head", request("HEAD /page.css"));
  seeds.add("http", "expect",
            "POST /v1/predict HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 3\r\n\r\nabc");
  seeds.add("http", "chunked", "POST /v1/predict HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n");
  seeds.add("form_data", "fields", type + "\n" + fields);
  seeds.add("form_data", "poses", "multipart/form-data; boundary=\"XX\"\n" + part("poses", "90,90;0,45.5") + "--XX--");
  for (const char* word : {"boundary=",
                           "multipart/form-data; ",
                           "Content-Disposition: form-data; name=",
                           "--XX\r\n",
                           "--XX--",
                           "\r\n\r\n",
                           "poses",
                           "grid",
                           "even",
                           "count",
                           "lowest_phi_deg",
                           "exif_orientation",
                           "depth_unit",
                           "radius_m",
                           "centre_m",
                           "frame",
                           "nan",
                           "1e999",
                           "%00",
                           "%",
                           "Content-Length: ",
                           "Host: ",
                           "Transfer-Encoding: chunked",
                           "Content-Encoding: gzip",
                           "Expect: 100-continue",
                           "Range: bytes=0-",
                           "Authorization: Bearer ",
                           "Origin: ",
                           "Sec-Fetch-Site: cross-site",
                           "GET ",
                           "POST ",
                           "HEAD ",
                           "/v1/predict",
                           "/v1/camera-pose",
                           "?theta_deg=",
                           "&phi_deg=",
                           " HTTP/1.1\r\n"})
    for (const char* target : {"http", "form_data"}) seeds.add_word(target, word);
}

}  // namespace svnet::fuzz
