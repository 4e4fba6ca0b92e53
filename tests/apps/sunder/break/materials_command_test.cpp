// SPDX-License-Identifier: MIT
// `sunder materials` from outside.
#include <catch2/catch.hpp>

#include "mechanics/state/settings/named_materials.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("materials are listed with their sources, for people and programs", "[apps][materials]") {
  const Workplace here;
  const Outcome table = here.run({"materials"});
  CHECK(table.exit_code == 0);
  const Outcome list = here.run({"materials", "--json"});
  REQUIRE(list.exit_code == 0);
  const nlohmann::json all = list.json();
  REQUIRE(all.is_array());
  REQUIRE(all.size() == named_materials().size());
  for (std::size_t m = 0; m < named_materials().size(); ++m) {
    const NamedMaterial& material = named_materials()[m];
    CHECK(table.out.find(std::string(material.name)) != std::string::npos);
    CHECK(table.out.find(std::string(material.source)) != std::string::npos);
    const nlohmann::json& json = all[m];
    CHECK(json["name"] == material.name);
    CHECK(json["density"] == material.material.density);
    CHECK(json["fracture_energy"] == Approx(fracture_energy_of(material.material)));
  }
}

TEST_CASE("one material is shown by its name, and an unknown one has the nearest named",
          "[apps][materials]") {
  const Workplace here;
  const Outcome one = here.run({"materials", "Cast-Iron", "--json"});
  REQUIRE(one.exit_code == 0);
  const nlohmann::json shown = one.json();
  REQUIRE(shown.size() == 1);
  CHECK(shown[0]["name"] == "cast_iron");
  const Outcome none = here.run({"materials", "glas"});
  CHECK(none.exit_code == 3);
  CHECK(none.err.find("did you mean glass?") != std::string::npos);
  CHECK(none.out.empty());
  CHECK(here.run({"materials", "--jsn"}).exit_code == 2);
}
