#include "app/bench/setup/advice_report.h"

#include <fmt/format.h>

#include <string_view>

namespace frustumscreen::bench {

namespace {

double throw_ratio(const geometry::Pinhole& pinhole) {
    return pinhole.fx / pinhole.width;
}

std::string cost_words(const std::optional<SetUpCost>& cost) {
    return cost ? fmt::format("{:.2f} ({:.2f}) {:7.0f}", cost->times_first, cost->cpu_times_first,
                              1e-3 * cost->samples)
                : std::string();
}

std::string line_of(std::string_view name, const SetUpChoice& choice) {
    const settings::Settings& settings = choice.settings;
    const SetUpFigures& figures = choice.figures;
    const glm::dvec3 lens = settings.projector.table_from_projector.translation;
    return fmt::format(
        "{:12} {:5.2f} {:+5.2f} {:5.2f}  {:4.0f} {:4.0f} {:4.0f}  {:6.2f} {:6.3f}  {:4.0f} {:4.0f}  {:6.0f}  "
        "{:4.0f} x {:<4.0f} {:4.0f} {:4.0f} x {:<4.0f} {}{}\n",
        name, lens.z, lens.y, throw_ratio(settings.projector.pinhole), 1e3 * settings.prop.base_m,
        1e3 * settings.prop.top_m, 1e3 * settings.prop.height_m, figures.light.evenness, figures.reference,
        1e3 * figures.wide_height_m, 1e3 * figures.slim_height_m, figures.pixels, 1e3 * figures.reach_m.x,
        1e3 * figures.reach_m.y, 1e3 * figures.usual_height_m, 1e3 * figures.zone_m.x, 1e3 * figures.zone_m.y,
        cost_words(choice.cost), figures.covered ? "" : " the picture misses a part of the table");
}

std::string row_of(std::string_view name, const SetUpChoice& choice) {
    const settings::Settings& settings = choice.settings;
    const SetUpFigures& figures = choice.figures;
    const glm::dvec3 lens = settings.projector.table_from_projector.translation;
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    const std::string cost = choice.cost ? fmt::format("{:.4f},{:.4f},{:.0f}", choice.cost->times_first,
                                                       choice.cost->cpu_times_first, choice.cost->samples)
                                         : std::string(",,");
    return fmt::format(
        "{},{:.3f},{:.3f},{:.4f},{:.1f},{:.1f},{:.3f},{:.3f},{:.3f},{:.4f},{:.5f},{:.5f},{:.5f},"
        "{:.4f},{:.4f},{:.1f},{:.4f},{:.4f},{},{},{},{:.4f},{:.4f},{:.4f}\n",
        name, lens.z, lens.y, throw_ratio(pinhole), pinhole.cx, pinhole.cy, settings.prop.base_m,
        settings.prop.top_m, settings.prop.height_m, figures.light.evenness, figures.light.least,
        figures.light.most, figures.reference, figures.wide_height_m, figures.slim_height_m, figures.pixels,
        figures.reach_m.x, figures.reach_m.y, figures.covered ? 1 : 0, choice.works ? 1 : 0, cost,
        figures.usual_height_m, figures.zone_m.x, figures.zone_m.y);
}

} // namespace

std::string setup_table(const SetUpChoice& now, const std::vector<SetUpChoice>& choices,
                        const AdviceOptions& options) {
    const settings::Settings& settings = now.settings;
    const bool timed = now.cost.has_value();
    std::string table = fmt::format(
        "A table of {:g} x {:g} m; the picture is {} x {} pixels as it is, {} x {} in the choices.\n\n"
        "             lens  side  throw  prop, mm        darkest  light  artifact, mm  pixels  slides, mm   "
        "seen whole, mm  {}\n"
        "             m     m     ratio  base top high   /bright. sent   wide slim     on it   +-X  +-Y     "
        "high within     {}\n",
        settings.table.width_m, settings.table.depth_m, settings.projector.pinhole.width,
        settings.projector.pinhole.height,
        options.width > 0 ? options.width : settings.projector.pinhole.width,
        options.width > 0 ? options.height : settings.projector.pinhole.height,
        timed ? "  frame       samples" : "", timed ? "  x (CPU)        1000" : "");
    table += line_of("as it is", now);
    const SetUpChoice* const best = best_of(choices);
    for (const SetUpChoice& choice : choices) {
        const std::string name = fmt::format("{}{}", name_of(choice.mount),
                                             !choice.works     ? " no"
                                             : &choice == best ? " best"
                                                               : "");
        table += line_of(name, choice);
    }
    table += fmt::format(
        "\nlens: height above the table. side: distance behind the table's middle, negative in front of it. "
        "darkest/bright.: light\nof the darkest face over that of the brightest face, in the worst pose. "
        "light sent: "
        "what the artifact sends back in\nevery pose. artifact: heights of one as wide as high and of one "
        "half as wide. "
        "no: the choice misses {:g} darkest/bright.,\n{:g} x the present pixels, or {}. "
        "seen whole: a zone in which all eyes see an artifact\nof that height, 0.65 as wide, whole at any "
        "turn.\n",
        options.evenness, options.pixels,
        options.asks_for_zone()
            ? fmt::format("artifacts of {:.0f} mm that are seen whole within {:.0f} x {:.0f} mm",
                          1e3 * options.artifact_m, 1e3 * options.zone_m.x, 1e3 * options.zone_m.y)
            : std::string("the present size of artifacts"));
    if (timed) {
        table += "frame: time of a frame, and processor time in brackets, as a multiple of the present "
                 "settings'; the "
                 "prop stands at the\ntable's middle and turns in twelve steps; only of the best choices. "
                 "samples: drawn and "
                 "averaged for a frame.\n";
    }
    return table;
}

std::string setup_csv(const SetUpChoice& now, const std::vector<SetUpChoice>& choices) {
    std::string csv =
        "choice,lens_height_m,lens_side_m,throw_ratio,cx_px,cy_px,base_m,top_m,height_m,evenness,least_light,"
        "most_light,reference_light,wide_height_m,slim_height_m,pixels,reach_x_m,reach_y_m,covered,works,"
        "frame_times_now,frame_cpu_times_now,frame_samples,usual_height_m,zone_width_m,zone_depth_m\n";
    csv += row_of("as it is", now);
    for (const SetUpChoice& choice : choices) {
        csv += row_of(name_of(choice.mount), choice);
    }
    return csv;
}

std::string setup_toml(const SetUpChoice& choice) {
    const settings::Settings& settings = choice.settings;
    const glm::dvec3 lens = settings.projector.table_from_projector.translation;
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    return fmt::format(
        "[projector]\nwidth = {}\nheight = {}\nthrow_ratio = {:.3f}\ncx = {:.1f}\ncy = {:.1f}\n"
        "position_m = [0.0, {:.3f}, {:.3f}]\naim_m = [0.0, {:.3f}, 0.0]\n\n"
        "[prop]\nbase_m = {:.3f}\ntop_m = {:.3f}\nheight_m = {:.3f}\n",
        pinhole.width, pinhole.height, throw_ratio(pinhole), pinhole.cx, pinhole.cy, lens.y, lens.z,
        choice.mount == Mount::Tilted ? 0.0 : lens.y, settings.prop.base_m, settings.prop.top_m,
        settings.prop.height_m);
}

} // namespace frustumscreen::bench
