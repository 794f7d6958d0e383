#include "app/solid/obj_text.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace frustumscreen::solid {

namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr double max_coordinate = 1e9;
constexpr std::size_t max_name_bytes = 40;

/// Takes the next word from `rest`; empty at the end.
std::string_view take_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
    rest.remove_prefix(word.size());
    return word;
}

/// Takes what stands before the next slash, and the slash.
std::string_view take_part(std::string_view& rest) {
    const std::string_view part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    return part;
}

/// Without a comment, which begins with a `#` before which there is a blank or nothing.
std::string_view without_comment(std::string_view line) {
    for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1)) {
        if (at == 0 || blanks.find(line[at - 1]) != blanks.npos) {
            return line.substr(0, at);
        }
    }
    return line;
}

/// The whole word as a number.
template <typename Number> std::optional<Number> number_in(std::string_view word) {
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    Number number{};
    const char* const end = word.data() + word.size();
    const std::from_chars_result read = std::from_chars(word.data(), end, number);
    return !word.empty() && read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

class ObjReader {
public:
    ObjReader(std::string_view text, LengthUnit unit)
        : rest_(text), units_in_metre_(unit == LengthUnit::Millimetre ? 1000.0 : 1.0) {
        read_.mesh.unit = unit;
    }

    Result<ObjText> read() {
        while (!rest_.empty()) {
            const std::string statement = next_statement();
            std::string_view words = statement;
            const std::string_view keyword = take_word(words);
            if (keyword == "v") {
                TRY_VOID(read_vertex(words));
            } else if (keyword == "f") {
                TRY_VOID(read_face(words));
            } else if (keyword == "g" || keyword == "o") {
                name_ = group_name(take_word(words));
            } else if (!keyword.empty()) {
                leave_out(printable(keyword, max_name_bytes));
            }
        }
        if (read_.mesh.polygons.empty()) {
            return bad_input("prop_file.no_face",
                             "it has no face; a prop file is an OBJ with its vertices in lines `v x y z` and "
                             "its faces in lines `f 1 2 3`");
        }
        tell_left_out();
        return std::move(read_);
    }

private:
    /// Written at the end of a line, a name with a backslash would join the line with the next one.
    static std::string group_name(std::string_view word) {
        std::string name = word == "default" ? std::string() : printable(word, max_name_bytes);
        std::replace(name.begin(), name.end(), '\\', '_');
        return name;
    }

    std::string_view take_line() {
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end);
        rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min(rest_.size(), std::size_t{1}));
        ++lines_;
        return line;
    }

    /// The next line, joined with the following one if a backslash ends it; a comment does not continue on the next
    /// line.
    std::string next_statement() {
        line_ = lines_ + 1;
        std::string statement;
        while (true) {
            std::string_view line = without_comment(take_line());
            line = line.substr(0, line.find_last_not_of(blanks) + 1);
            const bool goes_on = line.ends_with('\\');
            line.remove_suffix(goes_on ? 1 : 0);
            statement += line;
            if (!goes_on || rest_.empty()) {
                return statement;
            }
            statement += ' ';
        }
    }

    Result<void> read_vertex(std::string_view words) {
        std::vector<double> numbers;
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
            TRY(const double number, coordinate(word));
            numbers.push_back(number);
        }
        if (numbers.size() < 3 || numbers.size() > 7) {
            return bad_input("prop_file.vertex",
                             "line {}: a vertex has three numbers, x, y and z, and this one has {}", line_,
                             numbers.size());
        }
        if (numbers.size() > 3) {
            leave_out("what follows x, y and z of a vertex");
        }
        if (read_.mesh.vertices.size() == max_vertices) {
            return bad_input("prop_file.vertices",
                             "line {}: it has more than {} vertices; a prop has 4 to 16 flat faces: draw its "
                             "shape alone",
                             line_, max_vertices);
        }
        read_.mesh.vertices.emplace_back(numbers[0], numbers[1], numbers[2]);
        read_.mesh.vertices.back() /= units_in_metre_;
        return {};
    }

    Result<double> coordinate(std::string_view word) const {
        const std::optional<double> number = number_in<double>(word);
        if (!number) {
            return bad_input("prop_file.number", "line {}: a number such as 12.5 is expected, not \"{}\"",
                             line_, printable(word, max_name_bytes));
        }
        if (!(std::abs(*number) <= max_coordinate)) { // refuses NaN too
            return bad_input("prop_file.coordinate",
                             "line {}: the coordinate {} is not allowed; allowed are numbers from {} to {}",
                             line_, printable(word, max_name_bytes), -max_coordinate, max_coordinate);
        }
        return *number;
    }

    Result<void> read_face(std::string_view words) {
        Polygon polygon{.corners = {}, .name = name_, .number = line_};
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
            if (polygon.corners.size() == max_polygon_corners) {
                return bad_input("prop_file.face_corners", "line {}: a face has more than {} corners", line_,
                                 max_polygon_corners);
            }
            TRY(const std::uint32_t corner, vertex_of(word));
            polygon.corners.push_back(corner);
        }
        if (polygon.corners.size() < 3) {
            return bad_input("prop_file.few_corners",
                             "line {}: a face has at least three corners, and this one has {}", line_,
                             polygon.corners.size());
        }
        corners_ += polygon.corners.size();
        if (read_.mesh.polygons.size() == max_polygons || corners_ > max_corners) {
            return bad_input("prop_file.polygons",
                             "line {}: it has more than {} faces, or more than {} corners of faces; a prop "
                             "has 4 to 16 flat faces: draw its shape alone",
                             line_, max_polygons, max_corners);
        }
        read_.mesh.polygons.push_back(std::move(polygon));
        return {};
    }

    /// The vertex of a corner written v, v/vt, v//vn or v/vt/vn.
    Result<std::uint32_t> vertex_of(std::string_view word) const {
        std::string_view rest = word;
        const std::optional<std::int64_t> vertex = number_in<std::int64_t>(take_part(rest));
        const std::string_view texture = take_part(rest);
        const std::string_view normal = take_part(rest);
        const auto slashes = std::count(word.begin(), word.end(), '/');
        const bool is_texture_well =
            slashes == 0 || (slashes == 2 && texture.empty()) || number_in<std::int64_t>(texture);
        const bool is_normal_well = slashes < 2 || number_in<std::int64_t>(normal);
        if (!vertex || !is_texture_well || !is_normal_well || slashes > 2) {
            return bad_input("prop_file.corner",
                             "line {}: a corner of a face is written 1, 1/1, 1//1 or 1/1/1, not \"{}\"",
                             line_, printable(word, max_name_bytes));
        }
        const auto count = static_cast<std::int64_t>(read_.mesh.vertices.size());
        if (*vertex == 0 || *vertex > count || *vertex < -count) {
            return bad_input("prop_file.no_vertex",
                             "line {}: there is no vertex {}; above this line there are {} of them, and the "
                             "first has the number 1",
                             line_, *vertex, count);
        }
        return static_cast<std::uint32_t>(*vertex > 0 ? *vertex - 1 : count + *vertex);
    }

    void leave_out(std::string what) {
        const bool is_known = std::any_of(left_out_.begin(), left_out_.end(),
                                          [&](const auto& known) { return known.first == what; });
        if (is_known) {
            return;
        }
        constexpr std::size_t max_named = 10;
        if (left_out_.size() < max_named) {
            left_out_.emplace_back(std::move(what), line_);
        } else {
            has_more_left_out_ = true;
        }
    }
    void tell_left_out() {
        for (const auto& [what, line] : left_out_) {
            read_.notes.push_back(
                fmt::format("left out, as a prop has no use for it: {} (line {})", what, line));
        }
        if (has_more_left_out_) {
            read_.notes.emplace_back("left out: more keywords that a prop has no use for");
        }
    }

    std::string_view rest_;
    double units_in_metre_;
    std::size_t lines_ = 0; ///< that were taken
    std::size_t line_ = 0;  ///< where the statement begins
    std::size_t corners_ = 0;
    std::string name_; ///< of the group
    std::vector<std::pair<std::string, std::size_t>> left_out_;
    bool has_more_left_out_ = false;
    ObjText read_;
};

} // namespace

Result<ObjText> parse_obj(std::string_view text, LengthUnit unit) {
    if (text.size() > max_obj_bytes) {
        return bad_input(
            "prop_file.bytes",
            "it has {} bytes, allowed are {}; a prop has 4 to 16 flat faces: draw its shape alone",
            text.size(), max_obj_bytes);
    }
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    text.remove_prefix(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    return ObjReader(text, unit).read();
}

} // namespace frustumscreen::solid
