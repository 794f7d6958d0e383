/// Which types a C++ file defines in which namespace: classes, enums and aliases.
///
/// Left out  forward declarations; what lies in a class, a function or an unnamed namespace; what a macro makes.
/// Threads   pure; any.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::tests {

struct TypeDefinition {
    std::string name; ///< with its namespaces; of a specialisation with its arguments: "a::Box<int>"
    std::string as;   ///< what an alias stands for; empty: a class or an enum, unlike every other
};

/// In the order of the text.
[[nodiscard]] std::vector<TypeDefinition> type_definitions(std::string_view text);

/// A name's definitions, file by file.
using DefinitionsByFile = std::map<std::string, std::set<std::string>>;

/// The names that two files define, unless both define an alias of the same type.
class OneDefinition {
public:
    void add(const std::string& file, std::string_view text);
    /// A sentence for each, which names the files.
    [[nodiscard]] std::vector<std::string> violations() const;

private:
    std::map<std::string, DefinitionsByFile> names_;
};

} // namespace frustumscreen::tests
