#include "app/programs/artifact/example_sites.h"

#include "app/simulation/site.h"
#include "assets_baked/artifacts/site_mesh.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace frustumscreen::programs {

namespace {

constexpr std::int64_t max_triangles = 6'000'000; ///< more would be reduced by the bake

struct Texts {
    std::string_view language, title, text;
};
struct Made {
    ExampleSite site;
    simulation::SiteKind kind;
    double side_m; ///< of the ground's longer side
    std::array<Texts, 5> texts;
};

const std::array<Made, 2>& made_sites() {
    static const std::array<Made, 2> sites{
        {{{"hill-town", "a town on a hill: terrain, houses, a church, a wall with towers"},
          simulation::SiteKind::HillTown,
          300.0,
          {{{"en", "A town on a hill",
             "Houses climb to a church behind a wall with towers. The town is made up by this exhibit's own "
             "program."},
            {"de", "Eine Stadt auf einem Hügel",
             "Hinter einer Mauer mit Türmen steigen Häuser zu einer Kirche an. Das Programm dieser "
             "Ausstellung hat die Stadt erfunden."},
            {"fr", "Une ville sur une colline",
             "Derrière un mur à tours, des maisons montent vers une église. Le programme de l'exposition a "
             "inventé la ville."},
            {"es", "Una ciudad en una colina",
             "Tras una muralla con torres, las casas suben hacia una iglesia. El programa de esta exposición "
             "inventó la ciudad."},
            {"el", "Μια πόλη σε λόφο",
             "Πίσω από ένα τείχος με πύργους, σπίτια ανεβαίνουν προς μια εκκλησία. Την πόλη την επινόησε το "
             "πρόγραμμα της έκθεσης."}}}},
         {{"excavation", "an excavation: squares dug to terraces, walls, columns, jars"},
          simulation::SiteKind::Excavation,
          60.0,
          {{{"en", "An excavation",
             "Walls, column drums and jars lie in squares dug into terraces. The place is made up by this "
             "exhibit's own program."},
            {"de", "Eine Ausgrabung",
             "In terrassenförmig ausgehobenen Quadraten liegen Mauern, Säulentrommeln und Krüge. Das "
             "Programm dieser Ausstellung hat den Ort erfunden."},
            {"fr", "Une fouille",
             "Dans des carrés creusés en terrasses gisent des murs, des tambours de colonnes et des jarres. "
             "Le programme de l'exposition a inventé le lieu."},
            {"es", "Una excavación",
             "En cuadros excavados en terrazas yacen muros, tambores de columna y jarras. El programa de "
             "esta exposición inventó el lugar."},
            {"el", "Μια ανασκαφή",
             "Σε τετράγωνα σκαμμένα σε βαθμίδες βρίσκονται τοίχοι, σπόνδυλοι κιόνων και πιθάρια. Τον τόπο "
             "τον επινόησε το πρόγραμμα της έκθεσης."}}}}}};
    return sites;
}

const Made* find(std::string_view name) {
    for (const Made& made : made_sites()) {
        if (made.site.name == name) {
            return &made;
        }
    }
    return nullptr;
}

} // namespace

bool is_example_site(std::string_view name) {
    return find(name) != nullptr;
}

std::vector<ExampleSite> example_sites() {
    std::vector<ExampleSite> sites;
    for (const Made& made : made_sites()) {
        sites.push_back(made.site);
    }
    return sites;
}

Result<bake::SourceMesh> make_example_site(std::string_view name, std::int64_t triangles) {
    const Made* const made = find(name);
    if (made == nullptr) {
        return bad_input("artifact.no_site",
                         "no example site is named '{}'; allowed are hill-town and excavation", name);
    }
    const auto min_triangles = static_cast<std::int64_t>(simulation::min_site_triangles);
    if (triangles < min_triangles || triangles > max_triangles) {
        return bad_input("artifact.site_triangles", "{} triangles are asked for; a site has {} to {}",
                         triangles, min_triangles, max_triangles);
    }
    const simulation::Site site = simulation::make_site({.kind = made->kind,
                                                         .triangles = static_cast<std::size_t>(triangles),
                                                         .seed = 1,
                                                         .size_m = made->side_m});
    bake::SourceMesh mesh = artifacts::mesh_of_site(site);
    for (glm::dvec3& at : mesh.positions) {
        at = {at.x, at.z, -at.y};
    }
    mesh.default_up = 'y';
    return mesh;
}

std::string example_site_text(std::string_view name) {
    const Made* const made = find(name);
    std::string text = fmt::format(
        "# A made-up site as a curator's folder has it. `frustumscreen-artifact {0} --folder FOLDER` writes "
        "this file beside\n"
        "# the model. Metres, +Y up. The colours have their light in them.\n"
        "scan = \"{0}.glb\"\nid = \"frustumscreen-{0}\"\nlicence = \"Apache-2.0\"\nunlit = true\n\n"
        "[placement]\nturn_deg = 0\n\n"
        "# Visitors can have each region of its ground large in the prop "
        "(docs/sites.md).\n[site]\n#max_triangles = 150000\n",
        name);
    for (const Texts& each : made->texts) {
        text += fmt::format("\n[[texts]]\nlanguage = \"{}\"\ntitle = \"{}\"\ncredit = \"FrustumScreen, "
                            "Apache-2.0\"\ntext = \"{}\"\n",
                            each.language, each.title, each.text);
    }
    return text;
}

} // namespace frustumscreen::programs
