#include "app/counts/day_counts.h"

#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <limits>
#include <numeric>
#include <utility>

namespace frustumscreen::counts {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* mark = "frustumscreen_counts";
constexpr int version = 1;
constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max(); ///< a day has fewer milliseconds

Tally sum_of(const Tallies& tallies) {
    return std::accumulate(tallies.begin(), tallies.end(), Tally{},
                           [](Tally sum, const auto& each) { return sum += each.second; });
}

Json json_of(const Tallies& tallies) {
    Json all = Json::array();
    for (const auto& [name, tally] : tallies) {
        all.push_back({{"name", name}, {"visits", tally.visits}, {"ms", tally.ms}});
    }
    return all;
}

void add_to(Tallies& tallies, std::string_view name, const Tally& tally) {
    const bool has_space = tallies.size() < max_counted_names || tallies.contains(std::string(name));
    tallies[std::string(has_space ? name : other_names)] += tally;
}

tl::unexpected<Error> damaged(std::string_view what) {
    return bad_input("counts.damaged", "{}; these numbers are damaged", what);
}

std::optional<Tally> tally_in(const nlohmann::json& entry) {
    const auto number = [&entry](const char* key) -> std::optional<std::uint64_t> {
        const auto found = entry.find(key);
        return found != entry.end() && found->is_number_unsigned() && found->get<std::uint64_t>() <= most
                   ? std::optional(found->get<std::uint64_t>())
                   : std::nullopt;
    };
    const auto visits = entry.is_object() ? number("visits") : std::nullopt;
    const auto ms = entry.is_object() ? number("ms") : std::nullopt;
    return visits && ms ? std::optional(Tally{*visits, *ms}) : std::nullopt;
}

/// Calls `take` with each entry of a list; returns false if there is no list, or an entry is invalid.
template <typename Take> bool each_in(const nlohmann::json& document, const char* key, const Take& take) {
    const auto list = document.find(key);
    if (list == document.end() || !list->is_array()) {
        return false;
    }
    for (const nlohmann::json& entry : *list) {
        const std::optional<Tally> tally = tally_in(entry);
        if (!tally || !take(entry, *tally)) {
            return false;
        }
    }
    return true;
}

bool read_names(const nlohmann::json& document, const char* key, Tallies& tallies) {
    return each_in(document, key, [&tallies](const nlohmann::json& entry, const Tally& tally) {
        const auto name = entry.find("name");
        return name != entry.end() && name->is_string() && tallies.size() <= max_counted_names &&
               tallies.emplace(printable(name->get<std::string>(), Sentence::longest), tally).second;
    });
}

} // namespace

void DayCounts::add(const VisitPiece& piece, std::size_t hour) {
    const auto ms = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(piece.length).count());
    hours.at(hour) += {piece.begins ? 1U : 0U, ms};
    add_to(artifacts, printable(piece.artifact.view(), Sentence::longest),
           {piece.new_artifact ? 1U : 0U, ms});
    add_to(languages, printable(piece.language.view(), Sentence::longest),
           {piece.new_language ? 1U : 0U, ms});
}

void DayCounts::add(const DayCounts& other) {
    for (std::size_t hour = 0; hour < hours.size(); ++hour) {
        hours[hour] += other.hours[hour];
    }
    for (const auto& [name, tally] : other.artifacts) {
        add_to(artifacts, name, tally);
    }
    for (const auto& [name, tally] : other.languages) {
        add_to(languages, name, tally);
    }
}

Tally DayCounts::all() const {
    return std::accumulate(hours.begin(), hours.end(), Tally{},
                           [](Tally sum, const Tally& each) { return sum += each; });
}

std::string write_day_counts(const DayCounts& counts) {
    Json hours = Json::array();
    for (std::size_t hour = 0; hour < counts.hours.size(); ++hour) {
        if (const Tally& tally = counts.hours[hour]; tally != Tally{}) {
            hours.push_back({{"hour", hour}, {"visits", tally.visits}, {"ms", tally.ms}});
        }
    }
    const Json document = {{mark, version},
                           {"day", counts.day ? Json(text_of_day(*counts.day)) : Json(nullptr)},
                           {"hours", hours},
                           {"artifacts", json_of(counts.artifacts)},
                           {"languages", json_of(counts.languages)}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<DayCounts> parse_day_counts(std::string_view text) {
    const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
    if (!document.is_object() || !document.contains(mark)) {
        return bad_input("counts.none", "this is not a day's counts");
    }
    if (document.at(mark) != version) {
        return bad_input("counts.version",
                         "another version of FrustumScreen wrote these counts; read them with that version");
    }
    DayCounts counts;
    const auto day = document.find("day");
    if (day != document.end() && day->is_string()) {
        counts.day = parse_day(day->get<std::string>());
    }
    if (day == document.end() || (!day->is_null() && !counts.day)) {
        return damaged("their day is not valid");
    }
    const bool has_hours = each_in(document, "hours", [&](const nlohmann::json& entry, const Tally& tally) {
        const auto hour = entry.find("hour");
        if (hour == entry.end() || !hour->is_number_unsigned() ||
            hour->get<std::uint64_t>() >= counts.hours.size()) {
            return false;
        }
        counts.hours.at(hour->get<std::size_t>()) += tally;
        return true;
    });
    if (!has_hours || !read_names(document, "artifacts", counts.artifacts) ||
        !read_names(document, "languages", counts.languages)) {
        return damaged("an hour, an artifact or a language in them is not valid");
    }
    const std::uint64_t ms = counts.all().ms;
    if (sum_of(counts.artifacts).ms != ms || sum_of(counts.languages).ms != ms) {
        return damaged("the times of hours, artifacts and languages have different sums");
    }
    return counts;
}

} // namespace frustumscreen::counts
