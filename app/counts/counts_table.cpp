#include "app/counts/counts_table.h"

#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace frustumscreen::counts {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_lines = 12; ///< of artifacts, and of languages
constexpr std::array<const char*, 7> weekday_names{"Monday", "Tuesday",  "Wednesday", "Thursday",
                                                   "Friday", "Saturday", "Sunday"};

/// From Monday.
std::size_t weekday_of(std::chrono::sys_days day) {
    return std::chrono::weekday(day).iso_encoding() - 1;
}

std::vector<NamedTally> ranked(const Tallies& tallies) {
    std::vector<NamedTally> all;
    for (const auto& [name, tally] : tallies) {
        all.push_back({name, tally});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const NamedTally& a, const NamedTally& b) { return a.tally.ms > b.tally.ms; });
    return all;
}

/// Quotes a text; a text that begins like a formula must not become one in a spreadsheet.
std::string csv_field(const std::string& text) {
    std::string quoted = "\"";
    if (!text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos) {
        quoted += '\'';
    }
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

void add_rows(std::string& csv, const DayCounts& counts) {
    const std::string day = counts.day ? text_of_day(*counts.day) : "";
    const auto add = [&](const char* kind, const std::string& name, const Tally& tally) {
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{:.2f}\n", day, kind, name, tally.visits,
                       minutes_of(tally));
    };
    for (std::size_t hour = 0; hour < counts.hours.size(); ++hour) {
        if (counts.hours[hour] != Tally{}) {
            add("hour", std::to_string(hour), counts.hours[hour]);
        }
    }
    for (const auto& [name, tally] : counts.artifacts) {
        add("artifact", csv_field(name), tally);
    }
    for (const auto& [name, tally] : counts.languages) {
        add("language", csv_field(name), tally);
    }
}

void add_list(std::string& text, const char* title, const std::vector<NamedTally>& all) {
    fmt::format_to(std::back_inserter(text), "\n{:<44} {:>9} {:>9}\n", title, "minutes", "visits");
    for (std::size_t k = 0; k < std::min(all.size(), max_lines); ++k) {
        fmt::format_to(std::back_inserter(text), "{:<44} {:>9} {:>9}\n",
                       all[k].name.empty() ? "(none)" : all[k].name, grouped(whole_minutes_of(all[k].tally)),
                       grouped(all[k].tally.visits));
    }
    if (all.size() > max_lines) {
        fmt::format_to(std::back_inserter(text), "and {} more; --csv and --json have all\n",
                       all.size() - max_lines);
    }
}

Json json_of(const Tallies& tallies) {
    Json all = Json::array();
    for (const auto& [name, tally] : tallies) {
        all.push_back({{"name", name}, {"visits", tally.visits}, {"minutes", minutes_of(tally)}});
    }
    return all;
}

Json json_of(const DayCounts& counts) {
    Json hours = Json::array();
    for (std::size_t hour = 0; hour < counts.hours.size(); ++hour) {
        if (const Tally& tally = counts.hours[hour]; tally != Tally{}) {
            hours.push_back({{"hour", hour}, {"visits", tally.visits}, {"minutes", minutes_of(tally)}});
        }
    }
    return {{"day", counts.day ? Json(text_of_day(*counts.day)) : Json(nullptr)},
            {"visits", counts.all().visits},
            {"minutes", minutes_of(counts.all())},
            {"hours", hours},
            {"artifacts", json_of(counts.artifacts)},
            {"languages", json_of(counts.languages)}};
}

} // namespace

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::ptrdiff_t at = std::ssize(text) - 3; at > 0; at -= 3) {
        text.insert(static_cast<std::size_t>(at), " ");
    }
    return text;
}

CountsSummary summary_of(const std::vector<DayCounts>& days) {
    CountsSummary summary;
    DayCounts all;
    for (const DayCounts& each : days) {
        if (!each.day) {
            continue;
        }
        summary.first = summary.days == 0 ? *each.day : std::min(summary.first, *each.day);
        summary.last = summary.days == 0 ? *each.day : std::max(summary.last, *each.day);
        ++summary.days;
        all.add(each);
        summary.weekdays.at(weekday_of(*each.day)) += each.all();
        ++summary.days_of_weekday.at(weekday_of(*each.day));
    }
    summary.all = all.all();
    summary.hours = all.hours;
    summary.artifacts = ranked(all.artifacts);
    summary.languages = ranked(all.languages);
    return summary;
}

std::string counts_text(const ReadCounts& counts) {
    const CountsSummary summary = summary_of(counts.days);
    std::string text;
    const auto out = std::back_inserter(text);
    if (summary.days == 0) {
        text = "No visits have been counted yet.\n";
    } else {
        fmt::format_to(out, "{} to {}, {} with numbers\n", text_of_day(summary.first),
                       text_of_day(summary.last),
                       summary.days == 1 ? "1 day" : fmt::format("{} days", summary.days));
        fmt::format_to(out, "{} visits, {} minutes in all", grouped(summary.all.visits),
                       grouped(whole_minutes_of(summary.all)));
        if (summary.all.visits > 0) {
            const auto by_visits = [](const Tally& a, const Tally& b) { return a.visits < b.visits; };
            const auto hour = std::max_element(summary.hours.begin(), summary.hours.end(), by_visits) -
                              summary.hours.begin();
            std::size_t weekday = 0;
            const auto a_day = [&](std::size_t k) {
                return summary.days_of_weekday.at(k) == 0
                           ? 0.0
                           : static_cast<double>(summary.weekdays.at(k).visits) /
                                 static_cast<double>(summary.days_of_weekday.at(k));
            };
            for (std::size_t k = 1; k < summary.weekdays.size(); ++k) {
                weekday = a_day(k) > a_day(weekday) ? k : weekday;
            }
            fmt::format_to(out,
                           ", {:.1f} minutes each\nmost visits begin between {}:00 and {}:00, and on a {}\n",
                           minutes_of(summary.all) / static_cast<double>(summary.all.visits), hour, hour + 1,
                           weekday_names.at(weekday));
        } else {
            text += "\n";
        }
        add_list(text, "artifact", summary.artifacts);
        add_list(text, "language", summary.languages);
    }
    if (const Tally undated = counts.undated.all(); undated != Tally{}) {
        fmt::format_to(out,
                       "\nWhile the clock was wrong: {} visits, {:.0f} minutes, on days that are not known\n",
                       grouped(undated.visits), minutes_of(undated));
    }
    return text;
}

std::string counts_csv(const ReadCounts& counts) {
    std::string csv = "day,kind,name,visits,minutes\n";
    for (const DayCounts& each : counts.days) {
        add_rows(csv, each);
    }
    add_rows(csv, counts.undated);
    return csv;
}

std::string counts_json(const ReadCounts& counts) {
    Json days = Json::array();
    for (const DayCounts& each : counts.days) {
        days.push_back(json_of(each));
    }
    const Json document = {
        {"days", days},
        {"undated", counts.undated.all() == Tally{} ? Json(nullptr) : json_of(counts.undated)},
        {"trouble", counts.trouble}};
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::counts
