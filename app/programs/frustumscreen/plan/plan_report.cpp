#include "app/programs/frustumscreen/plan/plan_report.h"

#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> faces_of(const scene::ScenePlan& plan) {
    std::vector<std::string> names;
    for (std::size_t face = 0; face < plan.prop.faces.size(); ++face) {
        if (((plan.faces >> face) & 1U) != 0) {
            names.emplace_back(plan.prop.faces[face].name);
        }
    }
    return names;
}

template <typename List> std::string joined(const List& list) {
    std::string text;
    for (const auto& each : list) {
        text += (text.empty() ? "" : ", ") + std::string(each);
    }
    return text.empty() ? "none" : text;
}

std::vector<std::string> names_of(const std::set<scene::ShaderKey>& shaders) {
    std::vector<std::string> names;
    names.reserve(shaders.size());
    for (const scene::ShaderKey& key : shaders) {
        names.push_back(scene::name_of(key));
    }
    return names;
}

std::string size(std::int64_t bytes) {
    const double b = static_cast<double>(bytes);
    return std::abs(b) < 1e6 ? fmt::format("{:.0f} kB", 1e-3 * b) : fmt::format("{:.1f} MB", 1e-6 * b);
}

/// "Saves 3.2 MB of GPU memory, 4.1 MB of RAM and 12 microseconds a frame."
std::string savings(const SceneCost& saved) {
    std::vector<std::string> parts;
    if (saved.gpu_bytes >= 500) {
        parts.push_back(size(saved.gpu_bytes) + " of GPU memory");
    }
    if (saved.ram_bytes >= 500) {
        parts.push_back(size(saved.ram_bytes) + " of RAM");
    }
    if (saved.frame_us > saved.spread_us && saved.frame_us >= 1.0) {
        parts.push_back(fmt::format("{:.0f} microseconds a frame", saved.frame_us));
    }
    if (parts.empty()) {
        return "Saves nothing that could be measured.";
    }
    std::string text = "Saves " + parts.front();
    for (std::size_t k = 1; k < parts.size(); ++k) {
        text += (k + 1 == parts.size() ? " and " : ", ") + parts[k];
    }
    return text + ".";
}

std::string needs_text(const PlanReport& report) {
    const scene::ScenePlan& plan = report.measured.show->plan(0);
    const show::ShowUse use = report.measured.show->use();
    std::string text = "The exhibit needs\n";
    const auto out = std::back_inserter(text);
    for (const residency::LevelUse& level : report.measured.show->levels(0).uses()) {
        if (level.blocks > 0) {
            fmt::format_to(out, "  relief of {} texels: {} blocks{}\n", level.level, level.blocks,
                           level.on_gpu ? ", drawn by the GPU" : "");
            continue;
        }
        fmt::format_to(out, "  level {}: {} triangles, a texture of {} x {} texels\n", level.level,
                       level.triangles, level.texture.x, level.texture.y);
    }
    fmt::format_to(out, "  faces of the prop: {}\n", joined(faces_of(plan)));
    fmt::format_to(out, "  captions: {}\n",
                   use.captions == 0   ? "none"
                   : use.captions == 1 ? "one text"
                                       : fmt::format("{} texts", use.captions));
    fmt::format_to(out, "  samples a pixel that the render target holds, wherever the prop stands: {}\n",
                   use.samples);
    fmt::format_to(out, "  shader programs: {}\n", joined(names_of(use.shaders)));
    fmt::format_to(out, "  tracker: {}{}\n", settings::name_of(report.devices.tracker),
                   report.devices.head ? ", the viewer's head is followed" : "");
    fmt::format_to(out, "  torch: {}\n", settings::name_of(report.devices.torch));
    fmt::format_to(out, "  screen behind the table: {}\n", report.devices.screen ? "yes" : "none");
    fmt::format_to(out, "  button panel: {}\n", report.devices.panel ? "yes" : "none");
    fmt::format_to(out, "  threads of its own: {}\n", joined(report.devices.threads));
    return text;
}

std::string left_out_text(const PlanReport& report) {
    std::string text = "It leaves out\n";
    const auto out = std::back_inserter(text);
    const std::vector<scene::LeftOut>& left_out = report.measured.show->plan(0).left_out;
    for (const CullSaving& each : report.measured.cull_kinds) {
        for (const scene::LeftOut& item : left_out) {
            if (item.cull_kind == each.cull_kind) {
                fmt::format_to(out, "  {}: {}.\n", item.what, item.why);
            }
        }
        fmt::format_to(out, "    {}\n", savings(each.saved));
    }
    for (const std::string& sentence : report.devices.left_out) {
        fmt::format_to(out, "  {}\n", sentence);
    }
    if (left_out.empty() && report.devices.left_out.empty()) {
        text += "  nothing: this scene needs all that there is\n";
    }
    return text;
}

Json cost_json(const SceneCost& cost) {
    return {{"gpu_bytes", cost.gpu_bytes},
            {"ram_bytes", cost.ram_bytes},
            {"load_ms", cost.load_ms},
            {"frame_us", cost.frame_us}};
}

Json saving_json(const SceneCost& cost) {
    Json json = cost_json(cost);
    json["frame_spread_us"] = cost.spread_us;
    return json;
}

Json needs_json(const PlanReport& report) {
    const scene::ScenePlan& plan = report.measured.show->plan(0);
    const show::ShowUse use = report.measured.show->use();
    Json levels = Json::array();
    for (const residency::LevelUse& level : report.measured.show->levels(0).uses()) {
        levels.push_back({{"level", level.level},
                          {"blocks", level.blocks},
                          {"triangles", level.triangles},
                          {"unseen_triangles", level.unseen_triangles},
                          {"unseen_clusters", level.unseen_clusters},
                          {"finest_mip", level.finest_mip},
                          {"texture", {level.texture.x, level.texture.y}},
                          {"planned_gpu_bytes", level.planned_gpu_bytes},
                          {"gpu_bytes", level.gpu_bytes}});
    }
    Json quality_levels = Json::array();
    for (const scene::QualityLevel& quality_level : plan.quality_levels) {
        quality_levels.push_back({{"technique", scene::name_of(quality_level)},
                                  {"level", quality_level.level},
                                  {"samples", quality_level.samples},
                                  {"enough", quality_level.enough}});
    }
    return {{"levels", levels},
            {"rungs", quality_levels},
            {"faces", faces_of(plan)},
            {"captions", plan.captions},
            {"samples", use.samples},
            {"planned_programs", names_of(use.planned_shaders)},
            {"programs", names_of(use.shaders)},
            {"planned_gpu_bytes", use.planned_gpu_bytes},
            {"gpu_bytes", use.gpu_bytes},
            {"tracker", std::string(settings::name_of(report.devices.tracker))},
            {"head", report.devices.head},
            {"torch", settings::name_of(report.devices.torch)},
            {"screen", report.devices.screen},
            {"panel", report.devices.panel},
            {"threads", report.devices.threads}};
}

} // namespace

std::string plan_text(const PlanReport& report) {
    const PlanMeasurement& measured = report.measured;
    std::string text =
        fmt::format("{} with {}, technique {}\n\n", report.pack, report.config, report.technique);
    text += needs_text(report) + "\n" + left_out_text(report) + "\n";
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "Measured at {} {} on {}\n"
                   "                  as planned   with everything\n"
                   "  GPU memory   {:>13}   {:>15}\n"
                   "  RAM          {:>13}   {:>15}\n"
                   "  loading      {:>10.0f} ms   {:>12.0f} ms\n"
                   "  one frame    {:>10.2f} ms   {:>12.2f} ms\n",
                   measured.poses, measured.poses == 1 ? "pose" : "poses", measured.renderer,
                   size(measured.planned.gpu_bytes), size(measured.everything.gpu_bytes),
                   size(measured.planned.ram_bytes), size(measured.everything.ram_bytes),
                   measured.planned.load_ms, measured.everything.load_ms, 1e-3 * measured.planned.frame_us,
                   1e-3 * measured.everything.frame_us);
    return text;
}

std::string plan_json(const PlanReport& report) {
    const PlanMeasurement& measured = report.measured;
    Json left_out = Json::array();
    for (const scene::LeftOut& item : measured.show->plan(0).left_out) {
        left_out.push_back({{"economy", std::string(scene::name_of(item.cull_kind))},
                            {"what", item.what},
                            {"why", item.why}});
    }
    Json cull_kinds = Json::array();
    for (const CullSaving& each : measured.cull_kinds) {
        cull_kinds.push_back(
            {{"economy", std::string(scene::name_of(each.cull_kind))}, {"saves", saving_json(each.saved)}});
    }
    const Json json = {{"config", report.config},
                       {"pack", report.pack},
                       {"technique", report.technique},
                       {"in", needs_json(report)},
                       {"left_out", left_out},
                       {"left_out_devices", report.devices.left_out},
                       {"economies", cull_kinds},
                       {"measured",
                        {{"renderer", measured.renderer},
                         {"poses", measured.poses},
                         {"planned", cost_json(measured.planned)},
                         {"everything", cost_json(measured.everything)},
                         {"saved", saving_json(measured.saved)}}}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::programs
