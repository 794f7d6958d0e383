#include "app/bench/measures/scaling_bakes.h"

#include "firmware_host/base/json.h"
#include "firmware_host/base/run_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace frustumscreen::bench {

namespace {

/// The most time that a bake of a scan of up to `triangles` triangles may take, on two cores.
struct BakeLimit {
    std::uint64_t triangles;
    double seconds;
};
constexpr std::array<BakeLimit, 2> limits{{{21'000'000, 180.0}, {52'000'000, 480.0}}};
constexpr std::uint64_t max_memory = std::uint64_t{6} << 30U;

/// Removes the files when the measure ends, in whatever way.
class Removed {
public:
    explicit Removed(std::filesystem::path file) : file_(std::move(file)) {}
    Removed(const Removed&) = delete;
    Removed& operator=(const Removed&) = delete;
    ~Removed() {
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }
    [[nodiscard]] std::string name() const { return file_.string(); }

private:
    std::filesystem::path file_;
};

ProgramLimits bake_limits() {
    ProgramLimits limits;
    limits.time = std::chrono::hours(2);
    return limits;
}

std::string limit_lines(const ScalingBake& bake) {
    const auto* const limit = std::find_if(limits.begin(), limits.end(), [&](const BakeLimit& each) {
        return bake.triangles <= each.triangles;
    });
    const auto word = [](bool held) { return held ? "held  " : "MISSED"; };
    std::string lines;
    if (limit != limits.end()) {
        lines +=
            fmt::format("{} {} triangles are baked in <= {:g} s ({:.0f} s; {:.0f} s of processor time)\n",
                        word(bake.seconds <= limit->seconds), bake.triangles, limit->seconds, bake.seconds,
                        bake.processor_seconds);
    }
    return lines + fmt::format("{} {} triangles are baked in <= 6 GiB ({:.2f} GiB)\n",
                               word(bake.memory_bytes <= max_memory), bake.triangles,
                               static_cast<double>(bake.memory_bytes) / (1U << 30U));
}

} // namespace

Result<ScalingBake> bake_of_amphora(std::int64_t triangles, int size, const std::filesystem::path& programs,
                                    const std::filesystem::path& folder) {
    const Removed scan(folder / fmt::format("amphora-{}.glb", triangles));
    TRY_VOID(without_value(run_program({(programs / "frustumscreen-artifact").string(), "amphora",
                                        "--triangles", std::to_string(triangles), "-o", scan.name()},
                                       "", bake_limits())));
    return bake_of_file(scan.name(), size, programs, folder);
}

Result<ScalingBake> bake_of_file(const std::filesystem::path& scan, int size,
                                 const std::filesystem::path& programs, const std::filesystem::path& folder) {
    const Removed pack(folder / "bench-bake.fspack");
    TRY(const Bytes report, run_program({(programs / "frustumscreen-bake").string(), scan.string(), "-o",
                                         pack.name(), "--size", std::to_string(size), "--json"},
                                        "", bake_limits()));
    TRY(ScalingBake bake, scaling_bake_from(as_text(report)));
    std::error_code unknown;
    bake.scan_bytes = std::filesystem::file_size(scan, unknown);
    return bake;
}

Result<ScalingBake> scaling_bake_from(std::string_view report_json) {
    const nlohmann::json report = nlohmann::json::parse(report_json, nullptr, false);
    try {
        const nlohmann::json& levels = report.at("levels");
        return ScalingBake{
            .triangles = report.at("scan").at("triangles"),
            .scan_bytes = 0,
            .seconds = report.at("seconds"),
            .processor_seconds = report.at("processor_seconds"),
            .memory_bytes = report.at("memory_bytes"),
            .pack_bytes = report.at("bytes"),
            .shown_mean_mm = levels.at(report.at("default_level").get<std::size_t>()).at("mean_mm"),
            .min_mean_mm = levels.at(levels.size() - 1).at("mean_mm"),
            .levels = levels.size(),
        };
    } catch (const nlohmann::json::exception& error) {
        return bad_input("bench.no_bake_report", "the bake's report cannot be read: {}", error.what());
    }
}

std::string bakes_csv(std::span<const ScalingBake> bakes) {
    std::string csv = "triangles,scan_bytes,seconds,processor_seconds,memory_bytes,pack_bytes,shown_mean_mm,"
                      "min_mean_mm,levels\n";
    for (const ScalingBake& bake : bakes) {
        csv += fmt::format("{},{},{:.2f},{:.2f},{},{},{:.5f},{:.5f},{}\n", bake.triangles, bake.scan_bytes,
                           bake.seconds, bake.processor_seconds, bake.memory_bytes, bake.pack_bytes,
                           bake.shown_mean_mm, bake.min_mean_mm, bake.levels);
    }
    return csv;
}

std::string bakes_table(std::span<const ScalingBake> bakes) {
    std::string table =
        fmt::format("{:>16}{:>9}{:>9}{:>13}{:>12}{:>10}{:>12}{:>12}\n", "source triangles", "scan MB",
                    "seconds", "processor s", "memory MB", "pack MB", "shown mm", "finest mm");
    std::string lines;
    for (const ScalingBake& bake : bakes) {
        const auto mb = [](std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
        table +=
            fmt::format("{:>16}{:>9.0f}{:>9.1f}{:>13.1f}{:>12.0f}{:>10.1f}{:>12.4f}{:>12.4f}\n",
                        bake.triangles, mb(bake.scan_bytes), bake.seconds, bake.processor_seconds,
                        mb(bake.memory_bytes), mb(bake.pack_bytes), bake.shown_mean_mm, bake.min_mean_mm);
        lines += limit_lines(bake);
    }
    return table + lines;
}

} // namespace frustumscreen::bench
