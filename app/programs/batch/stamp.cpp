#include "app/programs/batch/stamp.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"

#include <exception>
#include <string_view>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view format = "FrustumScreen batch stamp 2";
constexpr std::uintmax_t largest_stamp = 1 << 20;

} // namespace

std::string_view name_of(BatchStatus status) {
    switch (status) {
    case BatchStatus::Baked:
        return "baked";
    case BatchStatus::Unchanged:
        return "unchanged";
    case BatchStatus::Failed:
        return "failed";
    case BatchStatus::Missing:
        break;
    }
    return "missing";
}

std::optional<Stamp> read_stamp(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, largest_stamp);
    if (!bytes) {
        return std::nullopt;
    }
    try {
        const Json json = Json::parse(as_text(*bytes));
        if (json.at("format") != format) {
            return std::nullopt;
        }
        Stamp stamp{json.at("key"), json.at("pack_sha256"), {}};
        stamp.row = {.object = json.at("object"),
                     .status = stamp.pack_sha256.empty() ? BatchStatus::Failed : BatchStatus::Unchanged,
                     .seconds = json.at("seconds"),
                     .sentence = json.at("sentence"),
                     .title = json.at("title"),
                     .levels = json.at("levels"),
                     .bytes = json.at("bytes"),
                     .mean_mm = json.at("mean_mm"),
                     .p95_mm = json.at("p95_mm"),
                     .colour_rmse = json.at("colour_rmse"),
                     .silent = json.at("silent"),
                     .has_page = json.at("page"),
                     .scan = summary_from(json.at("scan"))};
        stamp.row.scan.lost = json.at("lost");
        return stamp;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

Result<void> write_stamp(const std::filesystem::path& file, const Stamp& stamp) {
    const BatchRow& row = stamp.row;
    const Json json = {
        {"format", format},         {"key", stamp.key},       {"pack_sha256", stamp.pack_sha256},
        {"object", row.object},     {"seconds", row.seconds}, {"sentence", row.sentence},
        {"title", row.title},       {"levels", row.levels},   {"bytes", row.bytes},
        {"mean_mm", row.mean_mm},   {"p95_mm", row.p95_mm},   {"colour_rmse", row.colour_rmse},
        {"lost", row.scan.lost},    {"silent", row.silent},   {"page", row.has_page},
        {"scan", json_of(row.scan)}};
    return write_file(file, as_bytes(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"));
}

bool take_bake_report(std::string_view text, BatchRow& row) {
    try {
        const Json json = Json::parse(text);
        const Json& levels = json.at("levels");
        const Json& shown = levels.at(json.at("default_level").get<std::size_t>());
        row.title = json.at("title");
        row.levels = levels.size();
        row.bytes = json.at("bytes");
        row.mean_mm = shown.at("mean_mm");
        row.p95_mm = shown.at("p95_mm");
        row.colour_rmse = shown.at("colour_rmse");
        row.scan = summary_from(json.at("scan"));
        row.scan.lost = json.at("lost").size();
        row.silent = json.at("silent").size();
        row.has_page = json.contains("page");
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

} // namespace frustumscreen::programs
