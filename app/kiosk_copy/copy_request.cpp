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

namespace frustumscreen {

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

void read_what(TableReader& table, std::vector<std::string>& words, CopyRequest& request) {
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

void read_all(TableReader& table, CopyRequest& request) {
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

tl::unexpected<ImportFailure> failed(ImportRefusal refusal, std::string_view reason) {
    return tl::unexpected<ImportFailure>(
        ImportFailure{refusal, fmt::format("{}: {}", copy_request_name, reason), false});
}

} // namespace

Result<CopyRequest> parse_copy_request(std::string_view text) {
    ReadState state{std::string(copy_request_name), {}, {}, std::nullopt};
    CopyRequest request;
    read_toml(state, text, max_copy_request_bytes, [&](const toml::table& root) {
        TableReader table(state, &root, "");
        read_all(table, request);
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return request;
}

tl::expected<std::optional<CopyRequest>, ImportFailure>
read_copy_request(FileTree& stick, std::span<const TrustedKey> keys, std::string_view machine,
                  std::optional<std::chrono::sys_days> today) {
    TRY(const SignedText file, read_signed_text(stick, copy_request_name, max_copy_request_bytes));
    if (!file.text) {
        return std::optional<CopyRequest>();
    }
    if (keys.empty()) {
        return failed(
            ImportRefusal::WrongKey,
            "the kiosk's settings name no key, so it gives nothing away; bring settings with the museum's "
            "key first");
    }
    TRY_VOID(signer_of(copy_request_name, file, keys, today).map([](const Signer&) {}));
    const Result<CopyRequest> request = parse_copy_request(*file.text);
    if (!request) {
        return tl::unexpected<ImportFailure>(
            ImportFailure{ImportRefusal::NotAPack, request.error().message, false});
    }
    if (!request->machine.empty() && request->machine != machine) {
        return failed(ImportRefusal::WrongKey, fmt::format("it is for the machine {}, and this is {}",
                                                           request->machine, printable(machine, 64)));
    }
    if (today && *today > request->until) {
        return failed(
            ImportRefusal::Older,
            fmt::format("its last day, {}, is over: here it is {}; sign one with a later day, or set "
                        "the clock",
                        text_of_day(request->until), text_of_day(*today)));
    }
    return std::optional(*request);
}

} // namespace frustumscreen
