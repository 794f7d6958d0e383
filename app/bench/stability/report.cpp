#include "app/bench/stability/report.h"

#include "app/bench/truth/csv_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

std::string_view verdict(const StabilityRow& row) {
    return row.held() ? "held" : "MISSED";
}

} // namespace

bool all_held(std::span<const MeasuredCase> cases) {
    return std::all_of(cases.begin(), cases.end(), [](const MeasuredCase& one) {
        return std::all_of(one.result.rows.begin(), one.result.rows.end(),
                           [](const StabilityRow& row) { return row.held(); });
    });
}

std::string stability_table(std::span<const MeasuredCase> cases) {
    std::string table =
        fmt::format("{:<70}{:>10}{:>12}  {}\n", "case: quantity", "bound", "observed", "verdict");
    std::size_t rows = 0;
    std::size_t missed = 0;
    for (const MeasuredCase& one : cases) {
        table += fmt::format("{}: {}\n", one.theme, one.name);
        for (const StabilityRow& row : one.result.rows) {
            table += fmt::format("  {:<68}{:>10.3g}{:>12.3g}  {}\n", row.quantity, row.bound, row.observed,
                                 verdict(row));
            ++rows;
            missed += row.held() ? 0 : 1;
        }
        if (!one.result.left_out.empty()) {
            table += fmt::format("  left out: {}\n", one.result.left_out);
        }
    }
    return table + fmt::format("{} of {} bounds held\n", rows - missed, rows);
}

std::string stability_csv(std::span<const MeasuredCase> cases) {
    std::string csv = "theme,case,quantity,bound,observed,verdict\n";
    for (const MeasuredCase& one : cases) {
        for (const StabilityRow& row : one.result.rows) {
            csv += fmt::format("{},{},{},{:.9g},{:.9g},{}\n", one.theme, quoted(one.name),
                               quoted(row.quantity), row.bound, row.observed, verdict(row));
        }
        if (!one.result.left_out.empty()) {
            csv += fmt::format("{},{},{},,,left out\n", one.theme, quoted(one.name),
                               quoted(one.result.left_out));
        }
    }
    return csv;
}

std::string step_error_csv(std::span<const StepError> smoothers, std::span<const StepError> program) {
    std::string csv = "what,step,step_unit,error\n";
    for (const auto& [errors, unit] : {std::pair{smoothers, "time constants"}, std::pair{program, "s"}}) {
        for (const StepError& error : errors) {
            csv += fmt::format("{},{:.9g},{},{:.9g}\n", quoted(error.what), error.step, unit, error.error);
        }
    }
    return csv;
}

} // namespace frustumscreen::bench
