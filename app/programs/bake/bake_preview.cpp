#include "app/programs/bake/bake_preview.h"

#include "app/pack/pack_file.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/preview/preview_page.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/display/surfaceless_display.h"

#include <fmt/format.h>

#include <fstream>

namespace frustumscreen::programs {

namespace {

constexpr std::uintmax_t space_for_page = 32'000'000;
constexpr std::string_view page_begin = "<!doctype html>";

bool begins_as_page(const std::filesystem::path& file) {
    std::string begin(page_begin.size(), ' ');
    std::ifstream(file).read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin == page_begin;
}

/// A watched page has a third of the pictures, and smaller ones, because it is drawn again after each change.
TurnOptions turn_options(bool watched) {
    return watched ? TurnOptions{.columns = 6, .rows = 2, .size = {400, 280}, .projected_width = 960}
                   : TurnOptions{};
}

} // namespace

Result<void> check_preview(const BakeRequest& request) {
    if (request.preview.empty()) {
        return {};
    }
    TRY_VOID(check_output_is_no_input(request.preview, request.inputs));
    if (std::filesystem::absolute(request.preview).lexically_normal() ==
        std::filesystem::absolute(request.output).lexically_normal()) {
        return bad_input("preview.same_name", "{}: the pack and its preview have the same name; choose two",
                         request.output.string());
    }
    TRY_VOID(check_output_place(request.preview, space_for_page));
    std::error_code ignored;
    if (!request.force && std::filesystem::exists(request.preview, ignored) &&
        !begins_as_page(request.preview)) {
        return bad_input("preview.not_a_page",
                         "{}: this file exists and is not a page; choose another name for the preview, or "
                         "add --force to replace it",
                         request.preview.string());
    }
    if (const auto drawn = display::SurfacelessDisplay::create(16, 16); !drawn) {
        return bad_input("preview.not_drawn",
                         "{}: the preview cannot be drawn on this computer: {}; bake without --preview "
                         "here, and draw it on another",
                         request.preview.string(), drawn.error().message);
    }
    return {};
}

Result<std::uint64_t> write_preview(const BakeRequest& request, const BakeResult& result) {
    if (request.preview.empty()) {
        return 0;
    }
    ProgressLine progress("drawing the preview: ");
    TurnOptions options = turn_options(request.watched);
    options.progress = [&](std::string_view step, double done) { progress.show_share(step, done); };
    TRY(TurnPictures turn, turn_pictures(result.file, options));
    TRY(std::vector<ProjectedLanguage> languages,
        projected_texts(result.file, result.pack,
                        pack::place(result.pack, result.prop.shape).metres_per_box));
    TRY(std::vector<BehaviourPictures> behaviours, behaviour_pictures(result.file, options));
    TRY(std::vector<TorchPictures> torches, torch_pictures(result.file, result.pack, options));
    TRY(std::vector<StatePicture> states, state_pictures(result.file, result.pack, options));
    const PreviewMedia media{.turn = std::move(turn),
                             .table_picture = result.pack.table_picture,
                             .languages = std::move(languages),
                             .behaviours = std::move(behaviours),
                             .torches = std::move(torches),
                             .states = std::move(states)};
    const std::string page = preview_page(result.pack, preview_facts(result), media,
                                          request.watched ? PageKind::Reloading : PageKind::Final);
    TRY_VOID(write_file(request.preview, as_bytes(page)));
    return page.size();
}

} // namespace frustumscreen::programs
