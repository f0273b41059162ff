// camera_loop MODEL SOURCE [--frames N] [--headless] [--output LAST.png]: shows the scores of camera poses live, beside
// the picture of a camera that looks down on an object.
//
// SOURCE is the number of a camera, a video file or a folder of images. Only the square in the middle of a picture is
// used: put the object there. --headless opens no window. Ends after N frames, with the source, or by Esc or q.
//
//   c++ -std=c++17 camera_loop.cpp -o camera_loop $(pkg-config --cflags --libs svnet opencv4)
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <string>
#include <svnet/svnet.hpp>
#include <vector>

namespace {

constexpr int kSide = 480;  // pixels of the picture, and of the half-sphere beside it

struct Options {
  std::string model, source, output;
  long frames = -1;  // -1: all
  bool headless = false;
};

// Frames of a camera, a video file or a folder of images.
class Source {
 public:
  explicit Source(const std::string& name) {
    if (std::filesystem::is_directory(name)) {
      for (const auto& entry : std::filesystem::directory_iterator(name))
        if (cv::haveImageReader(entry.path().string())) images_.push_back(entry.path().string());
      std::sort(images_.begin(), images_.end());
      if (images_.empty()) throw std::runtime_error(name + ": the folder has no images");
      return;
    }
    const bool number = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    if (!(number ? video_.open(std::stoi(name)) : video_.open(name)))
      throw std::runtime_error(name + ": is no camera, video file or folder of images that OpenCV can open");
  }

  // The next frame; empty at the end.
  cv::Mat next() {
    cv::Mat frame;
    if (images_.empty())
      video_.read(frame);
    else if (next_ < images_.size())
      frame = cv::imread(images_[next_++]);
    return frame;
  }

 private:
  std::vector<std::string> images_;
  std::size_t next_ = 0;
  cv::VideoCapture video_;
};

// The top view, and rings every 15 degrees of elevation.
std::vector<svnet::CameraPose> candidates() {
  std::vector<svnet::CameraPose> poses{{90, 90}};
  for (int phi = 15; phi < 90; phi += 15)
    for (int theta = 0; theta < 360; theta += 15) poses.push_back({double(theta), double(phi)});
  return poses;
}

cv::Mat middle_square(const cv::Mat& frame) {
  const int side = std::min(frame.rows, frame.cols);
  return frame(cv::Rect((frame.cols - side) / 2, (frame.rows - side) / 2, side, side));
}

// The half-sphere from above, as it lies in the top image: the top view in the centre, theta 0 to the left, theta 90
// below. Colours go from the lowest score (dark blue) to the highest (yellow). The best pose has a red ring.
cv::Mat half_sphere(const std::vector<svnet::CameraPose>& poses, const std::vector<float>& scores, std::size_t best) {
  const auto [low, high] = std::minmax_element(scores.begin(), scores.end());
  cv::Mat levels(1, static_cast<int>(scores.size()), CV_8U), colours;
  for (std::size_t i = 0; i < scores.size(); ++i)
    levels.at<std::uint8_t>(static_cast<int>(i)) =
        cv::saturate_cast<std::uint8_t>(255 * (scores[i] - *low) / std::max(*high - *low, 1e-12f));
  cv::applyColorMap(levels, colours, cv::COLORMAP_VIRIDIS);

  cv::Mat picture(kSide, kSide, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double theta = poses[i].theta_deg * CV_PI / 180, r = (90 - poses[i].phi_deg) / 90 * (kSide / 2 - 10);
    const cv::Point place(cvRound(kSide / 2 - r * std::cos(theta)), cvRound(kSide / 2 + r * std::sin(theta)));
    cv::circle(picture, place, 8, cv::Scalar(colours.at<cv::Vec3b>(static_cast<int>(i))), cv::FILLED, cv::LINE_AA);
    if (i == best) cv::circle(picture, place, 12, cv::Scalar(0, 0, 255), 3, cv::LINE_AA);
  }
  return picture;
}

Options parse(int argc, char** argv) {
  Options options;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--headless")
      options.headless = true;
    else if (argument == "--frames" && i + 1 < argc)
      options.frames = std::stol(argv[++i]);
    else if (argument == "--output" && i + 1 < argc)
      options.output = argv[++i];
    else
      names.push_back(argument);
  }
  if (names.size() != 2)
    throw std::runtime_error("usage: camera_loop MODEL SOURCE [--frames N] [--headless] [--output LAST.png]");
  options.model = names[0];
  options.source = names[1];
  return options;
}

void run(const Options& options) {
  const svnet::ViewModel model(options.model);
  if (model.uses_depth())
    throw std::runtime_error(options.model + ": the model needs depth, which this example has not");
  const std::vector<svnet::CameraPose> poses = candidates();
  Source source(options.source);
  cv::Mat shown;
  for (long frame = 0; frame != options.frames; ++frame) {
    const cv::Mat picture = source.next();
    if (picture.empty()) break;
    const cv::Mat top = middle_square(picture);  // BGR; its rows have the distance of the whole picture's
    const auto start = std::chrono::steady_clock::now();
    const std::vector<float> features = model.embed({top.data, top.rows, top.cols, SVNET_BGR8, top.step});
    const std::vector<float> scores = model.scores(features, poses);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    const auto best = static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
    std::printf("frame %ld theta %g phi %g score %.4f (%.1f ms)\n", frame, poses[best].theta_deg, poses[best].phi_deg,
                static_cast<double>(scores[best]), taken.count());

    cv::Mat beside;
    cv::resize(top, beside, {kSide, kSide}, 0, 0, cv::INTER_AREA);
    cv::hconcat(beside, half_sphere(poses, scores, best), shown);
    if (options.headless) continue;
    cv::imshow("svnet", shown);
    if (const int key = cv::waitKey(1); key == 27 || key == 'q') break;
  }
  if (shown.empty()) throw std::runtime_error(options.source + ": no frame could be read");
  if (!options.output.empty() && !cv::imwrite(options.output, shown))
    throw std::runtime_error(options.output + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "camera_loop: %s\n", error.what());
    return 1;
  }
}
