// Feeds every file of the folders named on the command line to the fuzz target, and prints their number.
#include "firmware_host/base/file.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <vector>

int main(int count, char** arguments) {
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const char* folder : std::span(arguments, static_cast<std::size_t>(count)).subspan(1)) {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        const auto bytes = frustumscreen::read_file(file);
        frustumscreen::fuzz::require(bytes.has_value(), "a corpus file can be read", file.string());
        std::fprintf(stderr, "%s\n", file.c_str());
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
    }
    std::fprintf(stderr, "%zu inputs\n", files.size());
    return files.empty() ? 1 : 0;
}
