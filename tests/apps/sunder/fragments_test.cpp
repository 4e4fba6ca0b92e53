// SPDX-License-Identifier: MIT
// Laws of sizes found again in samples drawn from them; the table of fragments; the command.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/sunder/fragments/fragment_sizes.hpp"
#include "apps/sunder/fragments/fragments_report.hpp"
#include "tests/support/outside.hpp"
#include "tests/support/program.hpp"

namespace fs = std::filesystem;
using namespace sunder;
using namespace sunder::test;

namespace {

constexpr unsigned seed = 20261121;

/// `n` values of the law with the inverse upper tail `quantile`, ascending.
std::vector<double> sample(std::size_t n, unsigned number,
                           const std::function<double(double)>& quantile) {
  std::mt19937_64 random(seed + number);
  std::uniform_real_distribution<double> uniform(1e-12, 1);
  std::vector<double> values(n);
  for (double& x : values) x = quantile(uniform(random));
  std::ranges::sort(values);
  return values;
}

/// By Box and Muller.
std::vector<double> lognormal_sample(std::size_t n, unsigned number, double mean,
                                     double deviation) {
  std::mt19937_64 random(seed + number);
  std::uniform_real_distribution<double> uniform(1e-12, 1);
  std::vector<double> values(n);
  for (double& x : values) {
    const double r = std::sqrt(-2 * std::log(uniform(random)));
    x = std::exp(mean + deviation * r * std::cos(2 * 3.14159265358979 * uniform(random)));
  }
  std::ranges::sort(values);
  return values;
}

}  // namespace

TEST_CASE("laws drawn from are found again within three standard errors", "[run][fragments]") {
  INFO("seed " << seed);
  const std::size_t n = 2000;
  const double root = std::sqrt(static_cast<double>(n));
  const auto power = sample(n, 1, [](double u) { return 0.5 * std::pow(u, -1 / 1.7); });
  CHECK(std::abs(fit_law(SizeLaw::power, power, 0.5).parameters[0] - 1.7) < 3 * 1.7 / root);
  const auto exponential = sample(n, 2, [](double u) { return -std::log(u) / 4; });
  const FittedLaw e = fit_law(SizeLaw::exponential, exponential, 0);
  CHECK(std::abs(e.parameters[0] - 4) < 3 * 4 / root);
  const auto weibull = sample(n, 3, [](double u) { return 3 * std::pow(-std::log(u), 1 / 0.6); });
  const FittedLaw w = fit_law(SizeLaw::weibull, weibull, 0);
  CHECK(std::abs(w.parameters[0] - 0.6) < 3 * 0.78 * 0.6 / root);
  CHECK(std::abs(std::log(w.parameters[1] / 3)) < 3 * 1.05 / 0.6 / root);
  const auto lognormal = lognormal_sample(n, 4, -7, 1.3);
  const FittedLaw l = fit_law(SizeLaw::lognormal, lognormal, 0);
  CHECK(std::abs(l.parameters[0] + 7) < 3 * 1.3 / root);
  CHECK(std::abs(l.parameters[1] - 1.3) < 3 * 1.3 / std::sqrt(2.) / root);
  // Each law is the likeliest on its own sample, and near it as its own sample is.
  for (const auto& [law, values] : {std::pair{SizeLaw::exponential, exponential},
                                    {SizeLaw::weibull, weibull},
                                    {SizeLaw::lognormal, lognormal}}) {
    const FittedLaw own = fit_law(law, values, 0);
    CHECK(own.distance < 1.36 / root);
    for (const SizeLaw other : {SizeLaw::exponential, SizeLaw::weibull, SizeLaw::lognormal}) {
      const FittedLaw f = fit_law(other, values, 0);
      // Weibull's law holds the exponential one.
      const double room = law == SizeLaw::exponential ? 2e-3 : 1e-12;
      CHECK(f.log_likelihood <= own.log_likelihood + room);
    }
  }
}

TEST_CASE("what is fitted above a cut is the law of the whole", "[run][fragments]") {
  const auto weibull =
      sample(4000, 5, [](double u) { return 3 * std::pow(-std::log(u), 1 / 1.4); });
  const auto above = [](const std::vector<double>& values, double cut) {
    return std::vector<double>(std::ranges::lower_bound(values, cut), values.end());
  };
  const FittedLaw w = fit_law(SizeLaw::weibull, above(weibull, 2), 2);
  CHECK(w.parameters[0] == Approx(1.4).epsilon(0.1));
  CHECK(w.parameters[1] == Approx(3).epsilon(0.1));
  const auto lognormal = lognormal_sample(4000, 6, -7, 1.3);
  const double median = std::exp(-7.0);
  const FittedLaw l = fit_law(SizeLaw::lognormal, above(lognormal, median), median);
  CHECK(l.parameters[0] == Approx(-7).margin(0.5));
  CHECK(l.parameters[1] == Approx(1.3).epsilon(0.15));
  const auto exponential = sample(4000, 7, [](double u) { return -std::log(u) / 4; });
  CHECK(fit_law(SizeLaw::exponential, above(exponential, 0.5), 0.5).parameters[0] ==
        Approx(4).epsilon(0.15));
  CHECK(survival(w, 2) == Approx(1));
  CHECK(survival(w, 1e9) < 1e-12);
}

TEST_CASE("the cut of a power tail is found, and other tails are told from it",
          "[run][fragments]") {
  INFO("seed " << seed);
  // Uniform below 1, a power law above it: half of the sample each.
  const auto mixed =
      sample(3000, 8, [](double u) { return u > 0.5 ? 2 - 2 * u : std::pow(2 * u, -1 / 1.2); });
  const SampleLaws laws = fit_laws(mixed);
  REQUIRE(laws.tail.size() == 4);
  CHECK(laws.tail[0].cut > 0.8);
  CHECK(laws.tail[0].cut < 1.8);
  CHECK(laws.tail[0].parameters[0] == Approx(1.2).epsilon(0.12));
  CHECK(laws.against[0] > 2);
  // The other two hold it as a limit.
  CHECK((is_power_limit(laws.tail[2]) || std::abs(laws.against[1]) < 3));
  // An exponential tail is no power law once enough of it is seen.
  const auto exponential = sample(3000, 9, [](double u) { return 1 - std::log(u); });
  const FittedLaw power = fit_law(SizeLaw::power, exponential, 1);
  const FittedLaw own = fit_law(SizeLaw::exponential, exponential, 1);
  CHECK(vuong(power, own, exponential) < -2);
  CHECK(vuong(own, power, exponential) > 2);
}

TEST_CASE("too few pieces, or all alike, are fitted no law", "[run][fragments]") {
  const auto few = sample(fewest_for_fit - 1, 10, [](double u) { return 1 / u; });
  CHECK(fit_laws(few).whole.empty());
  CHECK(fit_laws(std::vector<double>(100, 2.0)).whole.empty());
  const auto enough = sample(fewest_for_fit, 10, [](double u) { return 1 / u; });
  CHECK(fit_laws(enough).whole.size() == 3);
  const PieceColumns pieces{few, few, std::vector<double>(few.size(), 1)};
  CHECK(fragments_text(measure_fragments(pieces, {}, SizeMeasure::mass)).find("below 50") !=
        std::string::npos);
}

TEST_CASE("two samples of one law are near, those of two are not", "[run][fragments]") {
  INFO("seed " << seed);
  const auto a = sample(400, 11, [](double u) { return -std::log(u); });
  const auto b = sample(900, 12, [](double u) { return -std::log(u); });
  const auto c = sample(900, 13, [](double u) { return -1.5 * std::log(u); });
  CHECK(sample_distance(a, b).probability > 0.01);
  CHECK(sample_distance(a, c).probability < 1e-4);
  CHECK(sample_distance(a, a).distance == 0);
  CHECK(sample_distance(a, std::vector<double>{1e9}).distance == 1);
  // Ties count once: three of four are at most 1 on one side, all on the other.
  CHECK(sample_distance(std::vector<double>{1, 1, 1, 2}, std::vector<double>{1, 1}).distance ==
        Approx(0.25));
}

TEST_CASE("pieces that are single elements have the mesh's own distribution", "[run][fragments]") {
  INFO("seed " << seed);
  const auto elements = lognormal_sample(2000, 14, -10, 0.4);
  PieceColumns pieces;
  for (std::size_t i = 0; i < elements.size(); i += 7) {
    pieces.volume.push_back(elements[i]);
    pieces.mass.push_back(2400 * elements[i]);
    pieces.tetrahedra.push_back(1);
  }
  for (const SizeMeasure measure : {SizeMeasure::volume, SizeMeasure::size, SizeMeasure::mass}) {
    const FragmentSizes sizes = measure_fragments(pieces, elements, measure);
    CHECK(sizes.from_elements.probability > 0.5);
    CHECK(sizes.single_part == Approx(1));
    const double log_deviation = sizes.laws.whole[2].parameters[1];
    CHECK(log_deviation == Approx(measure == SizeMeasure::size ? 0.4 / 3 : 0.4).epsilon(0.1));
  }
}

TEST_CASE("sunder fragments draws the sizes of a run", "[run][fragments]") {
  if (!has_program("gnuplot")) return;
  const Folder folder;
  const std::string out = (folder.path() / "out").string(),
                    png = (folder.path() / "sizes.png").string();
  REQUIRE(run_program("run " SUNDER_SCENES "/charts/monolith.json --set duration=0.05 --quiet -o " +
                      out)
              .exit_code == 0);
  CHECK(run_program("fragments " + out + " --png " + png).exit_code == 0);
  CHECK(bytes_of(png).starts_with("\x89PNG"));
}

TEST_CASE("sunder fragments reads a run and tells its sizes", "[run][fragments]") {
  const Folder folder;
  const std::string out = (folder.path() / "out").string();
  const Outcome ran =
      run_program("run " SUNDER_SCENES
                  "/charts/monolith.json --set duration=0.05 --set fracture.crack=paper --quiet "
                  "--frames 2 -o " +
                  out);
  INFO(ran.text());
  REQUIRE(ran.exit_code == 0);
  const Outcome text = run_program("fragments " + out);
  INFO(text.text());
  CHECK(text.exit_code == 0);
  CHECK(text.text().find("ln L / n") != std::string::npos);
  const Outcome json_said = run_program("fragments " + out + "/fragments.csv --by mass --json");
  REQUIRE(json_said.exit_code == 0);
  const auto json = nlohmann::json::parse(json_said.text());
  const auto report = nlohmann::json::parse(bytes_of(folder.path() / "out/report.json"));
  CHECK(json["pieces"] == report["components"]);
  CHECK(json["elements"]["count"] == report["tetrahedra"]);
  CHECK(json["largest"] == report["fragments"]["largest_mass"]);
  // The same from the mesh as from the first frame, to the frame's rounding.
  const auto meshed = nlohmann::json::parse(
      run_program("fragments " + out + " --by mass --json --mesh " SUNDER_MESHES "/monolith.msh")
          .text());
  CHECK(meshed["elements"]["median"].get<double>() ==
        Approx(json["elements"]["median"].get<double>()).epsilon(1e-6));

  CHECK(run_program("fragments " + (folder.path() / "none").string()).exit_code == 3);
  std::ofstream(folder.path() / "fragments.csv")
      << "mass,volume,tetrahedra\r\n1,2,1\r\n1,zero,1\r\n";
  const Outcome bad = run_program("fragments " + folder.path().string());
  CHECK(bad.exit_code == 3);
  CHECK(bad.text().find("fragments.csv:3") != std::string::npos);
  std::ofstream(folder.path() / "fragments.csv") << "mass,tetrahedra\r\n1,1\r\n";
  CHECK(run_program("fragments " + folder.path().string()).text().find("no column volume") !=
        std::string::npos);
}
