#include "app/programs/frustumscreen/guide/guide_command.h"

#include "app/exhibit/guidance_setup.h"
#include "app/guidance/advise.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/render/pose_input.h"
#include "app/settings/settings.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

struct Request {
    std::filesystem::path config;
    std::filesystem::path poses;
    std::filesystem::path pack; ///< empty: no artifact is known
    bool json = false;
};

/// The findings for one pose.
struct Guided {
    std::int64_t t_us = 0;
    guidance::FaceSets faces;
    double unlit_px = 0.0;
    bool knows_artifact = false;
    bool whole = false; ///< if the artifact is known
    std::optional<guidance::Advice> advice;
};

std::vector<std::string> names_of(std::uint32_t faces, const geometry::PropShape& prop) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        if ((faces >> k & 1U) != 0) {
            names.emplace_back(prop.faces[k].name);
        }
    }
    return names;
}

double degrees(double radians) {
    return radians * 180.0 / std::numbers::pi;
}

Json advice_json(const std::optional<guidance::Advice>& advice) {
    if (!advice) {
        return nullptr;
    }
    const guidance::Move& move = advice->move;
    return {{"action", guidance::name_of(move.action)},
            {"dx_m", move.by_m.x},
            {"dy_m", move.by_m.y},
            {"dz_m", move.by_m.z},
            {"turn_deg", degrees(move.turn_rad)},
            {"side",
             move.action == guidance::Action::ComeRound ? Json(guidance::name_of(move.side)) : Json(nullptr)},
            {"steps", advice->steps}};
}

std::string json_line(const Guided& guided, const geometry::PropShape& prop) {
    Json line{{"t_us", guided.t_us},
              {"seen", names_of(guided.faces.seen, prop)},
              {"lit", names_of(guided.faces.lit, prop)},
              {"valid", guided.faces.valid()},
              {"unlit_px", guided.unlit_px}};
    if (guided.knows_artifact) {
        line["whole"] = guided.whole;
    }
    line["advice"] = advice_json(guided.advice);
    return line.dump();
}

/// The move in words, seen from the table's front edge.
std::string words_of(const guidance::Move& move) {
    switch (move.action) {
    case guidance::Action::Slide:
        return fmt::format("slide it {:.0f} mm {} and {:.0f} mm {}", 1e3 * std::abs(move.by_m.x),
                           move.by_m.x < 0.0 ? "to the left" : "to the right", 1e3 * std::abs(move.by_m.y),
                           move.by_m.y < 0.0 ? "towards the front edge" : "away from the front edge");
    case guidance::Action::Turn:
        return fmt::format("turn it {} by {:.0f} degrees",
                           move.turn_rad > 0 ? "counter-clockwise" : "clockwise",
                           std::abs(degrees(move.turn_rad)));
    case guidance::Action::SetDown:
        return "set it down";
    case guidance::Action::Upright:
        return "stand it upright";
    case guidance::Action::ComeRound:
        return fmt::format("come round to the table's {}", guidance::name_of(move.side));
    case guidance::Action::Raise:
        return fmt::format("raise it by {:.0f} mm", 1e3 * move.by_m.z);
    case guidance::Action::Lower:
        return fmt::format("lower it by {:.0f} mm", -1e3 * move.by_m.z);
    case guidance::Action::Wait:
        break;
    }
    return "no known move of the visitor helps";
}

std::string text_words(const Guided& guided, const geometry::PropShape& prop) {
    const auto unlit = names_of(guided.faces.unlit(), prop);
    std::string line = fmt::format("sees {}", fmt::join(names_of(guided.faces.seen, prop), " "));
    if (!unlit.empty()) {
        line += fmt::format("; {} {} not lit, or not all of it", fmt::join(unlit, " "),
                            unlit.size() == 1 ? "is" : "are");
    }
    if (!guided.advice) {
        return line + (unlit.empty() ? "; all of it is lit" : ", but the artifact is seen whole");
    }
    line += "; " + words_of(guided.advice->move);
    return guided.advice->steps > 1 ? line + fmt::format(" (the first of {} steps)", guided.advice->steps)
                                    : line;
}

/// Corners of the artifact's hull, placed in the settings' prop.
Result<std::vector<glm::dvec3>> read_hull(const std::filesystem::path& pack,
                                          const geometry::PropShape& prop) {
    const auto only_default = [](const pack::PackOutline& outline) {
        return Result<std::vector<std::uint32_t>>(std::vector{outline.description.default_level});
    };
    TRY(const pack::VerifiedPack read, pack::load_pack(pack, only_default));
    return pack::hull_in(*read, prop);
}

/// As in the exhibit, advice is kept from pose to pose while it helps.
Result<void> guide(const Request& request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    TRY(const std::vector<tracking::TrackedState> frames,
        load_pose_frames(request.poses, settings->eye.default_m));
    guidance::GuidanceSetup setup = exhibit::guidance_setup(*settings);
    if (!request.pack.empty()) {
        TRY(setup.hull, read_hull(request.pack, setup.prop));
    }
    guidance::Advisor advisor(setup);
    const guidance::FaceReader& reader = advisor.reader();
    const geometry::PropShape& prop = setup.prop;
    std::string said; ///< the last line; a line is printed when the text changes
    for (const tracking::TrackedState& frame : frames) {
        const guidance::GuidedState tracked_state = exhibit::guided_state(setup, frame);
        const Guided guided{.t_us = to_microseconds(frame.time),
                            .faces = reader.read(tracked_state),
                            .unlit_px = reader.unlit_px(tracked_state),
                            .knows_artifact = !setup.hull.empty(),
                            .whole = reader.whole(tracked_state),
                            .advice = advisor.advise(tracked_state)};
        if (request.json) {
            fmt::print("{}\n", json_line(guided, prop));
        } else if (std::string words = text_words(guided, prop); words != said) {
            fmt::print("{:.3f} s: {}\n", 1e-6 * static_cast<double>(guided.t_us), words);
            said = std::move(words);
        }
    }
    return {};
}

} // namespace

int guide_command(int argc, char** argv) {
    Request request;
    CommandLine app("Lists for each pose the faces that the visitor sees, those that the projector lights, "
                    "and the one move\nthat lets the visitor see the whole artifact.",
                    "frustumscreen guide");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("--poses", request.poses, "pose file, CSV").required();
    app.add_option("--pack", request.pack,
                   "pack of the artifact; then only the faces that the artifact needs count");
    app.add_flag("--json", request.json, "print one JSON object per line");
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    return exit_status("frustumscreen", guide(request));
}

} // namespace frustumscreen::programs
