// SPDX-License-Identifier: MIT
// Moments of a film, and the words for ffmpeg.
#include "apps/sunder/render/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "apps/sunder/process/run_process.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/whole_number.hpp"
#include "topology/io/files/input_file.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

/// An encoder of twenty thousand pictures ends before it.
constexpr std::chrono::seconds longest_encoding{1800};
constexpr double most_pictures = 20000;

/// Words of the encoder by the ending of the film.
struct FilmKind {
  std::string_view ending;
  std::vector<std::string> words;
};

const std::array<FilmKind, 3>& film_kinds() {
  static const std::array<FilmKind, 3> kinds = {
      {{".mp4",
        {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "18", "-pix_fmt",
         "yuv420p", "-movflags", "+faststart"}},
       {".webm", {"-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-pix_fmt", "yuv420p"}},
       {".gif", {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}}}};
  return kinds;
}

const FilmKind* kind_of(const fs::path& file) {
  const auto found = std::ranges::find(film_kinds(), std::string_view(file.extension().native()),
                                       &FilmKind::ending);
  return found == film_kinds().end() ? nullptr : &*found;
}

std::size_t nearest(std::span<const double> times, double time) {
  const auto after = std::ranges::lower_bound(times, time);
  if (after == times.begin()) return 0;
  const auto row = static_cast<std::size_t>(after - times.begin());
  if (after == times.end()) return row - 1;
  return time - times[row - 1] <= times[row] - time ? row - 1 : row;
}

}  // namespace

bool is_film(const fs::path& file) { return kind_of(file) != nullptr; }

Result<FilmPlan> film_plan(std::span<const double> times, const FilmSpeed& speed) {
  const double life = times.empty() ? 0 : times.back() - times.front();
  if (!(life > 0)) {
    return Finding{.code = "one_frame",
                   .text = "the run has one frame, which makes no film",
                   .remedy = "run it with more frames: sunder run SCENE --frames 76"};
  }
  const double natural = static_cast<double>(times.size() - 1) / (speed.rate * life);
  const double slower = speed.slower.value_or(natural);
  const double last = std::round(life * slower * speed.rate);
  if (last + 1 > most_pictures) {
    return Finding{.code = "long_film",
                   .text = fmt::format("the film would have {:.3g} pictures, more than {:.0f}",
                                       last + 1, most_pictures),
                   .remedy = "make it less slow by --slower, or run with fewer frames"};
  }
  FilmPlan plan{.slower = slower};
  for (std::size_t k = 0; k <= whole_number<std::size_t>(last); ++k) {
    const double time = times.front() + static_cast<double>(k) / (speed.rate * slower);
    plan.frames.push_back(speed.slower ? nearest(times, time) : k);
  }
  plan.seconds = static_cast<double>(plan.frames.size()) / speed.rate;
  return plan;
}

std::string film_words(const FilmPlan& plan) {
  const bool is_fast = plan.slower < 1;
  const double times = is_fast ? 1 / plan.slower : plan.slower;
  return fmt::format("{}, {:.3g} s, {:.3g} times {} than life",
                     counted(plan.frames.size(), "picture"), plan.seconds, times,
                     is_fast ? "faster" : "slower");
}

std::string film_picture_name(std::size_t number) {
  return fmt::format("picture_{:06}.png", number);
}

std::optional<fs::path> find_encoder() { return find_program("ffmpeg"); }

std::string encoder_line(const fs::path& pictures, const fs::path& film, double rate) {
  return fmt::format("ffmpeg -framerate {:g} -i {} -pix_fmt yuv420p {}", rate,
                     shell_word((pictures / "picture_%06d.png").string()),
                     shell_word(film.string()));
}

std::optional<Finding> encode_film(const fs::path& encoder, const fs::path& pictures,
                                   const fs::path& film, double rate) {
  const FilmKind* kind = kind_of(film);
  const std::string made = "film" + film.extension().string();
  std::vector<std::string> words = {
      "-y", "-v", "error", "-framerate", fmt::format("{:.9g}", rate), "-i", "picture_%06d.png"};
  if (kind != nullptr) words.insert(words.end(), kind->words.begin(), kind->words.end());
  for (const char* word : {"-map_metadata", "-1", "-fflags", "+bitexact"}) words.emplace_back(word);
  words.push_back(made);
  const ProcessEnd end = run_process(encoder, words, pictures, longest_encoding);
  const Result<std::string> bytes = io::bytes_of_file(pictures / made);
  std::error_code none;
  fs::remove(pictures / made, none);
  if (end.exit_code != 0 || !bytes || bytes->empty()) {
    std::string last = plain_line(end.words);
    return Finding{.code = "not_encoded",
                   .text = fmt::format("{} made no film{}{}", encoder.string(),
                                       last.empty() ? "" : ": ", last),
                   .remedy =
                       "give another ending (.mp4, .webm, .gif), or a whole ffmpeg "
                       "(Debian: apt-get install ffmpeg)"};
  }
  return write_file(film, *bytes);
}

}  // namespace sunder
