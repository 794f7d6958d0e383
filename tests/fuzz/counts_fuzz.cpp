// A day of visits in its file: what is taken is written and taken again alike, adds up, and makes a picture and a table.
#include "app/counts/counts_plot.h"
#include "app/counts/counts_table.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Result<counts::DayCounts> counts = counts::parse_day_counts(fuzz::text_of(data, size));
    if (!counts) {
        fuzz::require_one_line(counts.error().message);
        return 0;
    }
    const Result<counts::DayCounts> again = counts::parse_day_counts(counts::write_day_counts(*counts));
    fuzz::require(again.has_value(), "what is written is taken", again ? "" : again.error().message);
    fuzz::require(*again == *counts, "it is taken as it was");
    std::uint64_t ms = 0;
    for (const auto& [name, tally] : counts->artifacts) {
        ms += tally.ms;
    }
    fuzz::require(ms == counts->all().ms, "artifacts add up to the hours");
    const std::string plot = counts::counts_plot({*counts});
    fuzz::require(plot.find("nan") == std::string::npos, "each number of the picture is one");
    fuzz::require(!counts::counts_csv({{*counts}, {}, {}}).empty(), "there is a table");
    return 0;
}
