#include "predict/taken_views.h"

#include <charconv>

#include "base/error.h"

namespace svnet {

TakenPicture taken_picture(const std::string& text) {
  const auto fail_form = [&] { fail("--taken: '", text, "' is not THETA,PHI=FILE, such as 45,60=view.png"); };
  TakenPicture taken;
  const char *at = text.data(), *const end = text.data() + text.size();
  const auto angle = [&](double& value, char after) {
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || next == end || *next != after) fail_form();
    at = next + 1;
  };
  angle(taken.pose.theta_deg, ',');
  angle(taken.pose.phi_deg, '=');
  if (at == end) fail_form();
  const std::string problem = view::pose_problem(taken.pose);
  check(problem.empty(), "--taken: '", text, "': ", problem);
  taken.picture = std::filesystem::path(at, end);
  return taken;
}

}  // namespace svnet
