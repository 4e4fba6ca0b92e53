// SPDX-License-Identifier: MIT
// Films: which frame is seen when, and pictures joined by ffmpeg, a program of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// Whether the ending of a file is that of a film: .mp4, .webm or .gif.
bool is_film(const std::filesystem::path& file);

/// How fast a film shows a run.
struct FilmSpeed {
  double rate = 25;  ///< pictures per second of film, > 0
  /// Times slower than life, > 0; absent: each frame is shown once.
  std::optional<double> slower;
};

/// The frame of each picture of a film.
struct FilmPlan {
  std::vector<std::size_t> frames;  ///< rows of the frames, one a picture, ascending
  double seconds = 0;               ///< of film
  double slower = 1;                ///< times slower than life; below 1 faster
};

/// A plan for frames at ascending `times` (s). With `slower` each picture shows the frame nearest
/// to its time. Errors: one_frame; long_film, above 20 000 pictures.
Result<FilmPlan> film_plan(std::span<const double> times, const FilmSpeed& speed);

/// "76 pictures, 3.04 s, 200 times slower than life".
std::string film_words(const FilmPlan& plan);

/// The name of a picture of a film: picture_000000.png and so on.
std::string film_picture_name(std::size_t number);

/// The encoder, ffmpeg, in the folders of PATH.
std::optional<std::filesystem::path> find_encoder();

/// The words that make a film of the pictures in a folder by hand, for a shell.
std::string encoder_line(const std::filesystem::path& pictures, const std::filesystem::path& film,
                         double rate);

/// Joins the pictures of a folder (`film_picture_name`, from 0 on) to a film. H.264 needs even
/// sides: an odd one gets a row or column of black. Leaves: the whole film, or none.
/// Errors: not_encoded, with the encoder's last words; cannot_write.
std::optional<Finding> encode_film(const std::filesystem::path& encoder,
                                   const std::filesystem::path& pictures,
                                   const std::filesystem::path& film, double rate);

}  // namespace sunder
