#include "app/programs/bake/load_scan.h"

#include "app/programs/bake/torch_layers.h"
#include "assets_baked/bake/last_look.h"
#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/reduce_scan.h"
#include "assets_baked/bake/table_under.h"
#include "assets_baked/bake/winding.h"
#include "assets_baked/folder/unused_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

/// True if the mesh has colours; without them an unlit mesh would be one flat area.
bool has_colours(const bake::SourceMesh& mesh) {
    const bool one_colour = std::all_of(mesh.materials.begin(), mesh.materials.end(), [&](const auto& each) {
        return each.base_colour == mesh.materials.front().base_colour;
    });
    return !mesh.textures.empty() || !mesh.colours.empty() || !one_colour;
}

/// --clean removes the flat surface under the object; without it the surface is reported.
void take_away_table(bake::SourceMesh& mesh, const bake::Scraps& scraps, bool clean) {
    const bake::Scraps table = bake::find_table(mesh, scraps);
    if (table.triangles == 0) {
        return;
    }
    const std::string what =
        fmt::format("{} of {} triangles are a flat surface under the object, such as a table",
                    table.triangles, mesh.triangles.size());
    if (clean) {
        mesh.notes.push_back({bake::SourceNote::Kind::Guessed, what + ": --clean leaves them out"});
        bake::remove_scraps(mesh, table);
    } else {
        mesh.notes.push_back({bake::SourceNote::Kind::Guessed,
                              what + ": leave them out with --clean, or cut them off in the scan"});
    }
}

/// A hint, not a loss: the curator may keep other files in the folder.
void note_unused_files(const BakeRequest& request, bake::SourceMesh& mesh) {
    if (request.folder.empty()) {
        return;
    }
    std::vector<std::filesystem::path> used = request.inputs;
    used.insert(used.end(), mesh.side_files.begin(), mesh.side_files.end());
    used.insert(used.end(), {request.output, request.preview});
    const std::vector<std::string> unused = folder::unused_files(request.folder, used);
    if (!unused.empty()) {
        mesh.notes.push_back({bake::SourceNote::Kind::Guessed, folder::sentence_on_unused(unused)});
    }
}

} // namespace

Result<bake::SourceMesh> load_scan(const BakeRequest& request,
                                   const std::function<void(std::string_view step, double done)>& progress) {
    constexpr double read_share = 0.6; // of a scan of many triangles
    const auto reading = [&](double done) { progress("reading the scan", read_share * done); };
    TRY(bake::SourceMesh mesh,
        bake::load_mesh(request.scan,
                        {request.texture, bake::useful_picture_texels(request.options.size), reading}));
    TRY_VOID(add_layers(request, mesh));
    progress("fewer triangles", read_share);
    if (request.options.unlit && !has_colours(mesh)) {
        mesh.notes.push_back(
            {bake::SourceNote::Kind::Lost,
             "light and shade: the file has no colours, and --unlit makes a flat picture of it; without "
             "--unlit it is lit as in a museum"});
    }
    bake::reduce_scan(mesh);
    progress("checking the scan", 0.9);
    bake::Scraps scraps = bake::find_scraps(mesh);
    if (request.clean && scraps.triangles > 0) {
        mesh.notes.push_back(
            {bake::SourceNote::Kind::Guessed,
             fmt::format("{} of {} triangles, which lie apart from the rest: --clean leaves them out",
                         scraps.triangles, mesh.triangles.size())});
        bake::remove_scraps(mesh, scraps);
        scraps = {};
    }
    take_away_table(mesh, scraps, request.clean);
    const std::size_t turned = request.clean ? bake::turn_outward(mesh) : 0;
    if (turned > 0) {
        mesh.notes.push_back(
            {bake::SourceNote::Kind::Guessed,
             fmt::format("{} of {} triangles, which were inside out in closed parts: --clean turns them",
                         turned, mesh.triangles.size())});
    }
    mesh.is_unlit = mesh.is_unlit && has_colours(mesh);
    const bake::Lighting light =
        mesh.is_unlit || request.options.unlit ? bake::Lighting::None : bake::Lighting::Museum;
    const std::vector<bake::SourceNote> looks = bake::last_look(mesh, scraps, light);
    mesh.notes.insert(mesh.notes.end(), looks.begin(), looks.end());
    if (mesh.is_unlit && !request.options.unlit) {
        mesh.notes.push_back({bake::SourceNote::Kind::Guessed,
                              "the file says that its colours already contain "
                              "light (KHR_materials_unlit): it is baked as with "
                              "--unlit"});
    }
    note_unused_files(request, mesh);
    return mesh;
}

std::vector<std::string> losses_in(const std::vector<bake::SourceNote>& notes) {
    std::vector<std::string> lost;
    for (const bake::SourceNote& note : notes) {
        if (note.kind == bake::SourceNote::Kind::Lost) {
            lost.push_back(note.text);
        }
    }
    return lost;
}

Result<void> check_losses(const std::vector<bake::SourceNote>& notes, const BakeRequest& request) {
    const std::vector<std::string> lost = losses_in(notes);
    if (request.strict && !lost.empty()) {
        return bad_input("bake.would_be_lost", "{}: this would be lost, and --strict forbids it: {}",
                         request.scan.string(), fmt::join(lost, "; "));
    }
    return {};
}

} // namespace frustumscreen::programs
