/// The byte dumps in docs/, which makes the documents' examples tests.
#pragma once

#include "firmware_host/base/file.h"
#include "tests/folders.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace frustumscreen::wire {

/// The bytes in the block of docs/`document` that begins with `start`, without the text after them in each
/// line.
inline Wire bytes_in_document(const std::string& document, const std::string& start) {
    const Result<Bytes> file = read_file(source_dir() + "/docs/" + document);
    const std::string text = file ? std::string(as_text(*file)) : std::string();
    const std::size_t begin = text.find("```text\n" + start);
    const std::size_t end = text.find("```", begin + 3);
    if (begin == std::string::npos || end == std::string::npos) {
        ADD_FAILURE() << document << " has no block that begins with " << start;
        return {};
    }
    std::istringstream lines(text.substr(begin + 8, end - begin - 8));
    Wire bytes;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        while (words >> word && word.size() == 2 &&
               word.find_first_not_of("0123456789ABCDEF") == std::string::npos) {
            bytes.push_back(from_hex(word)[0]);
        }
    }
    return bytes;
}

} // namespace frustumscreen::wire
