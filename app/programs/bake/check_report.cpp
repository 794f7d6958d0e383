#include "app/programs/bake/check_report.h"

#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t longest_name = 200;

std::string name_of(const CheckedScan& scan) {
    return printable(scan.input.string(), longest_name);
}

bool was_read(const CheckedScan& scan) {
    return !scan.summary.format.empty();
}

/// Characters of UTF-8 text.
std::size_t width_of(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(std::string_view text, std::size_t width, bool is_text) {
    const std::string blanks(width - std::min(width, width_of(text)), ' ');
    return is_text ? std::string(text) + blanks : blanks + std::string(text);
}

/// The sentence without the scan's name, which begins the line already.
std::string fault_of(const CheckedScan& scan) {
    const std::string prefix = scan.input.string() + ": ";
    const std::string& sentence = scan.fault->message;
    return sentence.starts_with(prefix) ? sentence.substr(prefix.size()) : sentence;
}

std::vector<std::string> texts_of(const CheckedScan& scan, bake::SourceNote::Kind kind) {
    std::vector<std::string> texts;
    for (const bake::SourceNote& note : scan.notes) {
        if (note.kind == kind) {
            texts.push_back(note.text);
        }
    }
    return texts;
}

struct TableColumn {
    bool is_text = true;
    std::vector<std::string> cells; ///< the heading first
};

std::string cell_in(const TableColumn& column, std::size_t row) {
    std::size_t width = 0;
    for (const std::string& cell : column.cells) {
        width = std::max(width, width_of(cell));
    }
    return padded(column.cells[row], width, column.is_text);
}

std::string table_row(const std::vector<TableColumn>& columns, std::size_t row) {
    std::string line;
    for (const TableColumn& column : columns) {
        line += (line.empty() ? "" : "  ") + cell_in(column, row);
    }
    return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

} // namespace

std::string check_lines(const CheckedScan& scan) {
    if (!was_read(scan)) {
        return {};
    }
    std::size_t width = 0;
    for (const ScanColumn& column : scan_columns()) {
        width = std::max(width, column.heading.size());
    }
    const auto line = [&](std::string_view heading, std::string_view text) {
        return fmt::format("  {}  {}\n", padded(heading, width, true), text);
    };
    std::string text = fmt::format("{}: {} be baked\n", name_of(scan), scan.fault ? "cannot" : "can");
    for (const ScanColumn& column : scan_columns()) {
        text += column.key == "lost" ? std::string() : line(column.heading, column.shown(scan.summary));
    }
    for (const auto& [heading, names] : {std::pair("parts", &scan.parts), {"animations", &scan.animations}}) {
        text += names->empty()
                    ? std::string()
                    : line(heading,
                           fmt::format("{}: {}", names->size(),
                                       printable(fmt::format("{}", fmt::join(*names, ", ")), longest_name)));
    }
    for (const std::string& each : scan.torches) {
        text += line("torch", each);
    }
    for (const std::string& each : scan.states) {
        text += line("state", each);
    }
    const std::vector<std::string> lost = texts_of(scan, bake::SourceNote::Kind::Lost);
    text += lost.empty() ? line("lost", "nothing") : std::string();
    for (const std::string& each : lost) {
        text += line("lost", each);
    }
    for (const std::string& each : texts_of(scan, bake::SourceNote::Kind::Guessed)) {
        text += line("guessed", each);
    }
    return text;
}

std::string check_table(std::span<const CheckedScan> scans) {
    std::vector<TableColumn> columns{{true, {"scan"}}};
    for (const CheckedScan& scan : scans) {
        columns[0].cells.push_back(name_of(scan));
    }
    for (const ScanColumn& column : scan_columns()) {
        TableColumn& made = columns.emplace_back(TableColumn{column.is_text, {std::string(column.heading)}});
        for (const CheckedScan& scan : scans) {
            made.cells.push_back(scan.fault ? std::string() : column.shown(scan.summary));
        }
    }
    std::string text = table_row(columns, 0);
    std::size_t good = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        good += scans[k].fault ? 0 : 1;
        text += scans[k].fault
                    ? fmt::format("{}  cannot be baked: {}\n", cell_in(columns[0], k + 1), fault_of(scans[k]))
                    : table_row(columns, k + 1);
    }
    text += fmt::format("{} scan{}: {} can be baked", scans.size(), scans.size() == 1 ? "" : "s", good);
    return text + (good < scans.size() ? fmt::format(", {} cannot\n", scans.size() - good) : "\n");
}

nlohmann::ordered_json check_json(std::span<const CheckedScan> scans) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const CheckedScan& scan : scans) {
        nlohmann::ordered_json one = {{"scan", scan.input.string()}, {"can_be_baked", !scan.fault}};
        if (scan.fault) {
            one["fault"] = scan.fault->message;
            one["id"] = scan.fault->id.view();
        }
        if (was_read(scan)) {
            one.update(json_of(scan.summary));
            one["parts"] = scan.parts;
            one["animations"] = scan.animations;
            one["torches"] = scan.torches;
            one["states"] = scan.states;
            one["lost"] = texts_of(scan, bake::SourceNote::Kind::Lost);
            one["guessed"] = texts_of(scan, bake::SourceNote::Kind::Guessed);
        }
        all.push_back(std::move(one));
    }
    return {{"scans", std::move(all)}};
}

} // namespace frustumscreen::programs
