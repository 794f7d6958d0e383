#include "app/counts/counts_plot.h"

#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace frustumscreen::counts {

namespace {

using std::chrono::sys_days;

constexpr double width = 1200.0;
constexpr double margin = 56.0;
constexpr double grid_left = margin + 46.0; ///< right of the hours' names
constexpr double hour_bars = 150.0;         ///< right of the grid
constexpr double gap = 24.0;
constexpr double row_height = 22.0;
constexpr double widest_column = 26.0;
constexpr double day_bars = 80.0; ///< above the grid
constexpr double list_row = 26.0;
constexpr std::size_t max_artifacts = 12, max_languages = 8;

constexpr const char* ink = "#1f2a2e";
constexpr const char* quiet_ink = "#66757a";
constexpr const char* hairline = "#d5dcdd";
constexpr const char* bar_colour = "#2a7f86";
/// One hue from light to dark, so that it is legible in grey print too.
constexpr std::array<std::array<double, 3>, 3> ramp{{{226, 240, 239}, {84, 165, 168}, {8, 64, 74}}};

constexpr std::array<const char*, 12> months{"January",   "February", "March",    "April",
                                             "May",       "June",     "July",     "August",
                                             "September", "October",  "November", "December"};

std::string colour_of(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (ramp.size() - 1);
    const auto from = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
    const double t = place - static_cast<double>(from);
    std::array<int, 3> code{};
    for (std::size_t k = 0; k < code.size(); ++k) {
        code[k] = static_cast<int>(std::lround((1.0 - t) * ramp[from][k] + t * ramp[from + 1][k]));
    }
    return fmt::format("#{:02x}{:02x}{:02x}", code[0], code[1], code[2]);
}

std::string day_words(sys_days day) {
    const std::chrono::year_month_day date(day);
    return fmt::format("{} {} {}", static_cast<unsigned>(date.day()),
                       months.at(static_cast<unsigned>(date.month()) - 1), static_cast<int>(date.year()));
}

/// Cuts a name to `most` characters, counted well enough for a list's column.
std::string shortened(const std::string& name, std::size_t most) {
    std::string text;
    std::size_t characters = 0;
    for (const char c : name) {
        const bool begins = (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
        if (begins && ++characters > most) {
            return text + "…";
        }
        text += c;
    }
    return text;
}

struct Place {
    double x = 0.0, y = 0.0;
};

class Sheet {
public:
    void rectangle(Place at, double wide, double high, std::string_view fill, std::string_view title = "") {
        fmt::format_to(out(), R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}")", at.x,
                       at.y, wide, high, fill);
        body_ += title.empty() ? "/>\n" : fmt::format("><title>{}</title></rect>\n", xml_text(title));
    }
    void text(Place at, std::string_view words, double size, std::string_view fill = ink,
              std::string_view anchor = "start", bool bold = false) {
        fmt::format_to(
            out(), R"(<text x="{:.1f}" y="{:.1f}" font-size="{:.0f}" fill="{}" text-anchor="{}"{}>{}</text>)",
            at.x, at.y, size, fill, anchor, bold ? R"( font-weight="600")" : "", xml_text(words));
        body_ += "\n";
    }
    void line(Place from, Place to) {
        fmt::format_to(out(), R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"/>)",
                       from.x, from.y, to.x, to.y, hairline);
        body_ += "\n";
    }
    [[nodiscard]] std::string take(double height) const {
        return fmt::format(
            R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}")"
            R"( font-family="'Noto Sans','Segoe UI','Helvetica Neue',Arial,sans-serif">
<rect width="{0:.0f}" height="{1:.0f}" fill="#ffffff"/>
{2}</svg>
)",
            width, height, body_);
    }

private:
    std::back_insert_iterator<std::string> out() { return std::back_inserter(body_); }
    std::string body_;
};

/// The days and hours of the grid, and its place.
struct Grid {
    sys_days first;
    std::size_t days = 1;
    std::size_t from_hour = 9, to_hour = 18; ///< `to_hour`: the end of the last one
    double column = 0.0, top = 0.0;

    Grid(const CountsSummary& summary, double grid_top) : first(summary.first), top(grid_top) {
        days = static_cast<std::size_t>((summary.last - summary.first).count()) + 1;
        const auto counts = [](const Tally& tally) { return tally != Tally{}; };
        const auto begin = std::find_if(summary.hours.begin(), summary.hours.end(), counts);
        if (begin != summary.hours.end()) {
            const auto end = std::find_if(summary.hours.rbegin(), summary.hours.rend(), counts).base();
            from_hour = static_cast<std::size_t>(begin - summary.hours.begin());
            to_hour = static_cast<std::size_t>(end - summary.hours.begin());
        }
        column = std::min(widest_column,
                          (width - margin - hour_bars - gap - grid_left) / static_cast<double>(days));
    }
    [[nodiscard]] double x(sys_days day) const {
        return grid_left + column * static_cast<double>((day - first).count());
    }
    [[nodiscard]] double y(std::size_t hour) const {
        return top + row_height * static_cast<double>(hour - from_hour);
    }
    [[nodiscard]] double right() const { return grid_left + column * static_cast<double>(days); }
    [[nodiscard]] double bottom() const { return y(to_hour); }
    [[nodiscard]] double cell() const { return column > 4.0 ? column - 1.0 : column; }
};

void draw_figures(Sheet& sheet, const CountsSummary& summary) {
    const std::uint64_t minutes = whole_minutes_of(summary.all);
    const double visits = static_cast<double>(summary.all.visits);
    const std::array<std::pair<std::string, const char*>, 4> figures{
        {{grouped(summary.all.visits), "visits"},
         {minutes < 600 ? grouped(minutes) : grouped((minutes + 30) / 60),
          minutes < 600 ? "minutes in all" : "hours in all"},
         {visits > 0 ? fmt::format("{:.1f}", minutes_of(summary.all) / visits) : "–", "minutes a visit"},
         {fmt::format("{:.0f}", visits / static_cast<double>(summary.days)), "visits a day"}}};
    sheet.text({margin, 58}, "Visits", 28, ink, "start", true);
    sheet.text({margin, 84},
               summary.first == summary.last
                   ? day_words(summary.first)
                   : fmt::format("{} to {}; {} days with numbers", day_words(summary.first),
                                 day_words(summary.last), summary.days),
               14, quiet_ink);
    for (std::size_t k = 0; k < figures.size(); ++k) {
        const double x = margin + 190.0 * static_cast<double>(k);
        sheet.text({x, 140}, figures[k].first, 34, bar_colour, "start", true);
        sheet.text({x, 162}, figures[k].second, 13, quiet_ink);
    }
}

/// Draws names of months, and of days if there is space for them.
void draw_days(Sheet& sheet, const Grid& grid) {
    double free_from = 0.0;
    const bool names_days = grid.column > 4.0;
    for (std::size_t k = 0; k < grid.days; ++k) {
        const sys_days day = grid.first + std::chrono::days(k);
        const std::chrono::year_month_day date(day);
        const bool begins_month = date.day() == std::chrono::day(1);
        const bool is_monday = std::chrono::weekday(day) == std::chrono::Monday;
        const double x = grid.x(day);
        if (begins_month || k == 0) {
            const std::string month = std::string(months.at(static_cast<unsigned>(date.month()) - 1));
            const std::string name = grid.days > 200 ? month.substr(0, 3) : month;
            if (x >= free_from && x + 7.0 * static_cast<double>(name.size()) < grid.right() + 60.0) {
                sheet.text({x, grid.bottom() + 34}, name, 12, ink);
                free_from = x + 7.5 * static_cast<double>(name.size()) + 8.0;
            }
            sheet.line({x, grid.bottom() + (names_days ? 4 : 22)}, {x, grid.bottom() + 38});
        }
        if (grid.column > 18.0 || (names_days && is_monday)) {
            sheet.text({x + 0.5 * grid.cell(), grid.bottom() + 16},
                       std::to_string(static_cast<unsigned>(date.day())), 11, is_monday ? ink : quiet_ink,
                       "middle");
        }
    }
}

void draw_hours(Sheet& sheet, const Grid& grid, const CountsSummary& summary) {
    double most = 0.0;
    const auto a_day = [&](std::size_t hour) {
        return static_cast<double>(summary.hours.at(hour).visits) / static_cast<double>(summary.days);
    };
    for (std::size_t hour = grid.from_hour; hour < grid.to_hour; ++hour) {
        most = std::max(most, a_day(hour));
    }
    const double left = grid.right() + gap;
    sheet.text({left, grid.top - 10}, "visits a day in this hour", 12, quiet_ink);
    for (std::size_t hour = grid.from_hour; hour < grid.to_hour; ++hour) {
        const double y = grid.y(hour);
        sheet.text({grid_left - 8, y + 15}, fmt::format("{}:00", hour), 11, quiet_ink, "end");
        const double length = most > 0.0 ? (hour_bars - 40.0) * a_day(hour) / most : 0.0;
        sheet.rectangle({left, y + 3}, length, row_height - 7, bar_colour);
        sheet.text({left + length + 6, y + 15}, fmt::format("{:.1f}", a_day(hour)), 11, quiet_ink);
    }
}

void draw_legend(Sheet& sheet, Place at, std::uint64_t most) {
    constexpr int steps = 24;
    constexpr double step = 5.0;
    sheet.text({at.x, at.y + 9}, "visits in an hour: 1", 11, quiet_ink, "end");
    for (int k = 0; k < steps; ++k) {
        sheet.rectangle({at.x + 8 + step * k, at.y}, step + 0.3, 11, colour_of(k / (steps - 1.0)));
    }
    sheet.text({at.x + 16 + step * steps, at.y + 9}, grouped(most), 11, quiet_ink);
}

void draw_grid(Sheet& sheet, const Grid& grid, const std::vector<DayCounts>& days) {
    std::uint64_t max_per_hour = 1;
    std::uint64_t max_per_day = 1;
    for (const DayCounts& day : days) {
        max_per_day = std::max(max_per_day, day.all().visits);
        for (const Tally& hour : day.hours) {
            max_per_hour = std::max(max_per_hour, hour.visits);
        }
    }
    sheet.text({grid_left, grid.top - day_bars - 22}, "Each day and each hour", 16, ink, "start", true);
    sheet.text({grid_left - 8, grid.top - day_bars + 4}, grouped(max_per_day), 11, quiet_ink, "end");
    sheet.text({grid_left - 8, grid.top - 8}, "visits", 11, quiet_ink, "end");
    sheet.line({grid_left, grid.top - day_bars}, {grid.right(), grid.top - day_bars});
    for (const DayCounts& day : days) {
        const double x = grid.x(*day.day);
        const std::uint64_t visits = day.all().visits;
        const double high = (day_bars - 6.0) * static_cast<double>(visits) / static_cast<double>(max_per_day);
        sheet.rectangle({x, grid.top - 6 - high}, grid.cell(), high, bar_colour,
                        fmt::format("{}: {} visits, {:.0f} minutes", text_of_day(*day.day), visits,
                                    minutes_of(day.all())));
        for (std::size_t hour = grid.from_hour; hour < grid.to_hour; ++hour) {
            const std::uint64_t count = day.hours.at(hour).visits;
            const double share = max_per_hour > 1 ? (static_cast<double>(count) - 1.0) /
                                                        (static_cast<double>(max_per_hour) - 1.0)
                                                  : 1.0;
            sheet.rectangle({x, grid.y(hour)}, grid.cell(), row_height - 1,
                            count == 0 ? "#f4f6f6" : colour_of(share),
                            fmt::format("{}, {}:00: {} visits", text_of_day(*day.day), hour, count));
        }
    }
    draw_legend(sheet, {width - margin - 170, grid.top - day_bars - 32}, max_per_hour);
}

/// `names`: width for the names. Returns the list's lower end.
double draw_list(Sheet& sheet, Place at, double wide, double names, const char* title,
                 const std::vector<NamedTally>& all, std::size_t most) {
    sheet.text(at, title, 16, ink, "start", true);
    const double longest = all.empty() ? 1.0 : std::max(minutes_of(all.front().tally), 1e-9);
    double y = at.y + 14;
    for (std::size_t k = 0; k < std::min(most, all.size()); ++k, y += list_row) {
        const double minutes = minutes_of(all[k].tally);
        const double length = (wide - names - 140.0) * minutes / longest;
        sheet.text(
            {at.x, y + 17},
            shortened(all[k].name.empty() ? "(none)" : all[k].name, static_cast<std::size_t>(names / 7.2)),
            13);
        sheet.rectangle({at.x + names, y + 4}, std::max(length, 1.0), list_row - 9, bar_colour);
        sheet.text({at.x + names + length + 8, y + 17},
                   fmt::format("{} min, {} visits", grouped(whole_minutes_of(all[k].tally)),
                               grouped(all[k].tally.visits)),
                   11, quiet_ink);
    }
    if (all.size() > most) {
        sheet.text({at.x, y + 17}, fmt::format("and {} more", all.size() - most), 12, quiet_ink);
        y += list_row;
    }
    return y;
}

} // namespace

std::string counts_plot(const std::vector<DayCounts>& days) {
    const CountsSummary summary = summary_of(days);
    Sheet sheet;
    if (summary.days == 0) {
        sheet.text({margin, 58}, "Visits", 28, ink, "start", true);
        sheet.text({margin, 90}, "No visits have been counted yet.", 14, quiet_ink);
        return sheet.take(130.0);
    }
    draw_figures(sheet, summary);
    const Grid grid(summary, 224.0 + day_bars);
    draw_grid(sheet, grid, days);
    draw_hours(sheet, grid, summary);
    draw_days(sheet, grid);
    const double lists = grid.bottom() + 96.0;
    const double half = 0.5 * (width - 2.0 * margin);
    const double artifacts_end =
        draw_list(sheet, {margin, lists}, 1.2 * half, 290.0, "How long each artifact was shown to visitors",
                  summary.artifacts, max_artifacts);
    const double languages_end = draw_list(sheet, {margin + 1.26 * half, lists}, 0.74 * half, 90.0,
                                           "In which language", summary.languages, max_languages);
    const double end = std::max(artifacts_end, languages_end) + 34.0;
    sheet.text(
        {margin, end},
        "A visit lasts from the first press or move until the exhibit rests. Visitors are not told apart.",
        12, quiet_ink);
    return sheet.take(end + 34.0);
}

} // namespace frustumscreen::counts
