#include "app/kiosk_copy/copy_request.h"

#include "app/library/report_request.h"
#include "app/library/signed_text.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::kiosk_copy {

namespace {

constexpr std::size_t max_machine_bytes = 64;

struct Part {
    std::string_view word;
    bool CopyRequest::*wanted;
};
constexpr std::array<Part, 4> parts{{{"settings", &CopyRequest::settings},
                                     {"calibration", &CopyRequest::calibration},
                                     {"counts", &CopyRequest::counts},
                                     {"packs", &CopyRequest::packs}}};

void read_what(settings::TableReader& table, std::vector<std::string>& words, CopyRequest& request) {
    table.texts("what", words, parts.size());
    for (const std::string& word : words) {
        bool known = false;
        for (const Part& part : parts) {
            if (word == part.word) {
                request.*part.wanted = known = true;
            }
        }
        table.require("copy_request.what", known, "what",
                      fmt::format("names \"{}\"; allowed are settings, calibration, counts and packs",
                                  printable(word, 40)));
    }
}

void read_all(settings::TableReader& table, CopyRequest& request) {
    std::vector<std::string> words;
    std::string until;
    read_what(table, words, request);
    table.flag("reset", request.reset, {});
    table.any_text("until", until);
    table.any_text("machine", request.machine);
    table.finish(); // a misspelt key is reported before a missing one
    table.require("copy_request.nothing", !words.empty() || request.reset, "what",
                  "is missing or empty; name one or more of settings, calibration, counts and packs");
    const std::optional<std::chrono::sys_days> day = parse_day(until);
    table.require("copy_request.until", day.has_value(), "until",
                  "is missing or not a day; allowed is the request's last day as a text, \"2031-12-31\"");
    request.until = day.value_or(std::chrono::sys_days());
    table.require("copy_request.machine", request.machine == printable(request.machine, max_machine_bytes),
                  "machine",
                  "is not a machine's name; allowed is that of the kiosk's folder, \"frustumscreen-1a2b3c\", "
                  "or leave it "
                  "out");
}

tl::unexpected<library::ImportFailure> failed(library::ImportRefusal refusal, std::string_view reason) {
    return tl::unexpected<library::ImportFailure>(
        library::ImportFailure{.refusal = refusal,
                               .reason = fmt::format("{}: {}", library::copy_request_name, reason),
                               .whole = false});
}

} // namespace

Result<CopyRequest> parse_copy_request(std::string_view text) {
    settings::ReadState state{
        .file = std::string(library::copy_request_name), .folder = {}, .lines = {}, .error = std::nullopt};
    CopyRequest request;
    settings::read_toml(state, text, library::max_copy_request_bytes, [&](const toml::table& root) {
        settings::TableReader table(state, &root, "");
        read_all(table, request);
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return request;
}

CopyRequest whole_copy() {
    return {.settings = true, .calibration = true, .counts = true, .packs = true, .by_staff = true};
}

tl::expected<std::optional<CopyRequest>, library::ImportFailure>
read_copy_request(FileTree& stick, std::span<const pack::TrustedKey> keys, std::string_view machine,
                  std::optional<std::chrono::sys_days> today) {
    TRY(const library::SignedText file,
        library::read_signed_text(stick, library::copy_request_name, library::max_copy_request_bytes));
    if (!file.text) {
        return std::optional<CopyRequest>();
    }
    if (keys.empty()) {
        return failed(
            library::ImportRefusal::WrongKey,
            "the kiosk's settings name no key, so it copies nothing; bring settings with the museum's "
            "key first");
    }
    TRY_VOID(
        library::signer_of(library::copy_request_name, file, keys, today).map([](const pack::Signer&) {}));
    const Result<CopyRequest> request = parse_copy_request(*file.text);
    if (!request) {
        return tl::unexpected<library::ImportFailure>(library::ImportFailure{
            .refusal = library::ImportRefusal::NotAPack, .reason = request.error().message, .whole = false});
    }
    if (!request->machine.empty() && request->machine != machine) {
        return failed(library::ImportRefusal::WrongKey,
                      fmt::format("it is for the machine {}, and this is {}", request->machine,
                                  printable(machine, 64)));
    }
    if (today && *today > request->until) {
        return failed(library::ImportRefusal::Older,
                      fmt::format("its last day, {}, has passed: the kiosk's date is {}; sign one with a "
                                  "later day, or set the clock",
                                  text_of_day(request->until), text_of_day(*today)));
    }
    return std::optional(*request);
}

} // namespace frustumscreen::kiosk_copy
