// The files that `frustumscreen status` reads: for any content, its output is printable lines, JSON, and one
// sample per line.
#include "app/status/exhibit_verdict.h"
#include "app/status/prometheus_text.h"
#include "app/status/status_document.h"
#include "app/status/status_lines.h"
#include "firmware_host/base/printable.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

void require_printable_lines(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        fuzz::require(end != std::string_view::npos, "the last line ends", text);
        const std::string_view line = text.substr(0, end);
        fuzz::require(line == printable(line, line.size()), "lines are printable", line);
        text.remove_prefix(end + 1);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(fuzz::text_of(data, size));
    const status::StatusClock clock{MonotonicTime(std::chrono::seconds(1000)), "boot"};
    const status::StatusDocument document = status::parse_status(text, clock);
    status::KnownExhibit known{
        document, {document, watch::parse_service_ends(text), text.size(), {}, 1000.0, {}, "system", {}, {}}};
    if (std::optional<watch::Crash> crash = watch::parse_crash(text)) {
        known.environment.crashes.push_back(*std::move(crash));
    }
    fuzz::require(document.fields.is_null() != document.why.empty(), "something is known, or why not");
    fuzz::require(status::verdict_of(known).runs || !status::verdict_of(known).well,
                  "what does not run is not well");
    require_printable_lines(status::status_text(known, 1'800'000'000));
    require_printable_lines(status::prometheus_text(known));
    fuzz::require(nlohmann::json::accept(status::status_document(known)), "it is JSON");
    return 0;
}
