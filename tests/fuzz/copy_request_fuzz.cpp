// A stick's request for a copy of the kiosk: refused in one line that begins with the file's name, or it asks for something.
#include "app/kiosk_copy/copy_request.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto request = parse_copy_request(fuzz::text_of(data, size));
    if (!request) {
        fuzz::require(request.error().message.starts_with("frustumscreen-request.toml"),
                      "a message names the file", request.error().message);
        fuzz::require_one_line(request.error().message);
        return 0;
    }
    fuzz::require(request->asks_for_copy() || request->reset, "something is asked for");
    return 0;
}
