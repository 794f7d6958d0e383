#include "app/programs/bake/check_scan.h"

#include "app/programs/bake/artifact_words.h"
#include "app/programs/bake/behaviours_of.h"
#include "app/programs/bake/load_scan.h"
#include "app/programs/bake/put_site.h"
#include "app/programs/bake/scan_about.h"
#include "app/programs/bake/states_of.h"
#include "app/programs/bake/torch_contents.h"

#include <algorithm>
#include <new>

namespace frustumscreen::programs {

namespace {

Result<void> look_at(const BakeArguments& arguments, CheckedScan& checked) {
    TRY(BakeRequest request, request_of(arguments));
    TRY(const bake::SourceMesh mesh, load_scan(request));
    checked.notes = mesh.notes;
    for (const bake::SourceNode& node : mesh.nodes) {
        checked.parts.push_back(node.name);
    }
    for (const bake::SourceAnimation& animation : mesh.animations) {
        checked.animations.push_back(animation.name);
    }
    TRY(const std::vector<pack::PackBehaviour> behaviours,
        movements_of(request, mesh,
                     choose_cells(request.cells, mesh, request.behaviours.size(), hides_parts(request)),
                     checked.notes));
    TRY(checked.states, check_states(request, mesh, behaviours));
    if (request.site) {
        TRY_VOID(at(request.scan.string(), check_site(mesh, *request.site, request.options)));
    }
    TRY(TorchContents torches, contents_of(request, mesh, Contents::Look));
    checked.torches = std::move(torches.told);
    checked.notes.insert(checked.notes.end(), torches.notes.begin(), torches.notes.end());
    TRY(const bake::ScanMeasures measures,
        at(request.scan.string(), bake::measure_scan(mesh, request.options)));
    checked.summary = summary_of(mesh, measures);
    CompletedRequest all = completed(std::move(request), mesh.about);
    checked.notes.insert(checked.notes.end(), all.notes.begin(), all.notes.end());
    all.request.speech.voice = std::nullopt; // what it cannot speak is silent, not lost
    TRY(const ArtifactWords words, words_of(all.request, behaviours));
    for (const std::string& lost : words.lost) {
        checked.notes.push_back({bake::SourceNote::Kind::Lost, lost});
    }
    checked.summary.lost = losses_in(checked.notes).size();
    return check_losses(checked.notes, all.request);
}

} // namespace

CheckedScan check_scan(BakeArguments arguments) {
    CheckedScan checked;
    checked.input = arguments.input;
    arguments.output = arguments.input.stem().string() + ".fspack";
    try {
        if (const Result<void> looked = look_at(arguments, checked); !looked) {
            checked.fault = looked.error();
        }
    } catch (const std::bad_alloc&) {
        checked.fault = Error{ErrorKind::BadInput, "check.no_memory",
                              arguments.input.string() + ": not enough memory; simplify the scan first"};
    }
    return checked;
}

ScanSummary summary_of(const bake::SourceMesh& mesh, const bake::ScanMeasures& measures) {
    ScanSummary summary;
    const glm::dvec3& extents = measures.extents;
    summary.format = mesh.contents.format;
    summary.triangles = mesh.reduced_from ? mesh.reduced_from->triangles : mesh.triangles.size();
    summary.vertices = mesh.reduced_from ? mesh.reduced_from->points : measures.points;
    for (const glm::ivec2& size : mesh.contents.picture_sizes) {
        summary.pictures.push_back({size.x, size.y});
    }
    summary.materials = mesh.materials.size();
    summary.has_colours = !mesh.colours.empty();
    summary.has_normals = !mesh.normals.empty();
    summary.extents = {extents.x, extents.y, extents.z};
    summary.unit = bake::guessed_unit(summary.format, std::max({extents.x, extents.y, extents.z}));
    summary.estimated_bytes = measures.estimated_bytes;
    summary.estimated_triangles = measures.estimated_triangles;
    return summary;
}

} // namespace frustumscreen::programs
