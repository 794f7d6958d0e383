// The importer's report: refused in one line, or it is printable, and written again it reads equal.
#include "app/library/import_report.h"
#include "firmware_host/base/printable.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto report = library::parse_import_report(fuzz::text_of(data, size));
    if (!report) {
        fuzz::require_one_line(report.error().message);
        return 0;
    }
    for (const std::string* text : {&report->import_id, &report->stick, &report->reason}) {
        fuzz::require(*text == printable(*text, 1000), "texts are printable", *text);
    }
    for (const library::ImportedPack& pack : report->packs) {
        for (const std::string* text : {&pack.file, &pack.title, &pack.reason}) {
            fuzz::require(*text == printable(*text, 1000), "texts are printable", *text);
        }
    }
    const auto again = library::parse_import_report(library::write_import_report(*report));
    fuzz::require(again && *again == *report, "written again it reads the same");
    return 0;
}
