#include "assets_baked/bake/loaders/ply_header.h"

#include "assets_baked/bake/loaders/source_about.h"
#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/trimmed.h"

#include <array>
#include <string_view>

namespace frustumscreen::bake {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Lines end with LF, CR LF or CR.
class LineReader {
public:
    explicit LineReader(std::string_view text) : text_(text) {}

    std::optional<std::string_view> next() {
        if (position_ >= text_.size()) {
            return std::nullopt;
        }
        ++line_;
        const std::size_t end = std::min(text_.find_first_of("\r\n", position_), text_.size());
        const std::string_view line = text_.substr(position_, end - position_);
        const bool two = text_.substr(end).starts_with("\r\n");
        position_ = std::min(end + (two ? 2 : 1), text_.size());
        return line;
    }
    [[nodiscard]] std::size_t line() const { return line_; }
    [[nodiscard]] std::size_t position() const { return position_; }

private:
    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
};

PlyType type_from(std::string_view name, std::size_t line) {
    using namespace std::string_view_literals;
    constexpr std::array names = {
        std::pair("char"sv, PlyType::I8),    std::pair("int8"sv, PlyType::I8),
        std::pair("uchar"sv, PlyType::U8),   std::pair("uint8"sv, PlyType::U8),
        std::pair("short"sv, PlyType::I16),  std::pair("int16"sv, PlyType::I16),
        std::pair("ushort"sv, PlyType::U16), std::pair("uint16"sv, PlyType::U16),
        std::pair("int"sv, PlyType::I32),    std::pair("int32"sv, PlyType::I32),
        std::pair("uint"sv, PlyType::U32),   std::pair("uint32"sv, PlyType::U32),
        std::pair("int64"sv, PlyType::I64),  std::pair("uint64"sv, PlyType::U64),
        std::pair("long"sv, PlyType::I64),   std::pair("ulong"sv, PlyType::U64),
        std::pair("float"sv, PlyType::F32),  std::pair("float32"sv, PlyType::F32),
        std::pair("double"sv, PlyType::F64), std::pair("float64"sv, PlyType::F64),
    };
    for (const auto& [known, type] : names) {
        if (name == known) {
            return type;
        }
    }
    refuse_damage("line {}: \"{}\" is not a type of PLY", line, name.substr(0, 40));
}

PlyProperty property_from(WordReader& words, std::size_t line) {
    PlyProperty property;
    std::string_view type = words.next();
    if (type == "list") {
        property.list_count = type_from(words.next(), line);
        if (*property.list_count == PlyType::F32 || *property.list_count == PlyType::F64) {
            refuse_damage("line {}: the length of a list is a whole number", line);
        }
        type = words.next();
    }
    property.type = type_from(type, line);
    property.name = words.next();
    return property;
}

void read_format(WordReader& words, PlyHeader& header, std::size_t line) {
    const std::string_view format = words.next();
    header.is_text = format == "ascii";
    header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (!header.is_text && format != "binary_little_endian" && format != "binary_big_endian") {
        refuse_damage("line {}: the format \"{}\" is not known", line, format.substr(0, 40));
    }
}

PlyElement element_from(WordReader& words, std::size_t line) {
    PlyElement element;
    element.name = words.next();
    const std::string_view count = words.next();
    const std::optional<std::int64_t> number = whole_from(count);
    if (!number || *number < 0) {
        refuse_damage("line {}: a number of elements is expected, not \"{}\"", line, count.substr(0, 40));
    }
    element.count = static_cast<std::uint64_t>(*number);
    return element;
}

void read_comment(std::string_view comment, PlyHeader& header) {
    constexpr std::string_view picture = "TextureFile";
    if (comment.starts_with(picture) &&
        (comment.size() == picture.size() || is_blank(comment[picture.size()]))) {
        header.pictures.emplace_back(trimmed(comment.substr(picture.size())));
        return;
    }
    take_comment(comment, header.about);
}

} // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
    case PlyType::I8:
    case PlyType::U8:
        return 1;
    case PlyType::I16:
    case PlyType::U16:
        return 2;
    case PlyType::I64:
    case PlyType::U64:
    case PlyType::F64:
        return 8;
    default:
        return 4;
    }
}

PlyHeader ply_header_from(ByteView file) {
    const std::string_view text = as_text(file);
    const std::size_t mark = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    LineReader lines(text.substr(mark));
    PlyHeader header;
    bool has_format = false;
    if (trimmed(lines.next().value_or("")) != "ply") {
        refuse_damage("line 1: \"ply\" is expected");
    }
    while (const std::optional<std::string_view> line = lines.next()) {
        WordReader words(*line);
        const std::string_view keyword = words.next();
        if (keyword == "format") {
            read_format(words, header, lines.line());
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(element_from(words, lines.line()));
        } else if (keyword == "property") {
            if (header.elements.empty()) {
                refuse_damage("line {}: a property comes before the first element", lines.line());
            }
            header.elements.back().properties.push_back(property_from(words, lines.line()));
        } else if (keyword == "comment" || keyword == "obj_info") {
            read_comment(trimmed(words.rest_of_line()), header);
        } else if (keyword == "end_header") {
            if (!has_format) {
                refuse_damage("the header does not say the format");
            }
            header.size = mark + lines.position();
            return header;
        } else if (!keyword.empty()) {
            refuse_damage("line {}: \"{}\" is not known in a PLY header", lines.line(),
                          keyword.substr(0, 40));
        }
    }
    refuse_cut_short("the header has no \"end_header\"");
}

} // namespace frustumscreen::bake
