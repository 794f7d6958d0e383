#include "tests/layers/type_definitions.h"

#include "tests/layers/cpp_tokens.h"

#include <algorithm>
#include <span>

namespace frustumscreen::tests {
namespace {

using Tokens = std::span<const std::string>;

bool is_class_key(const std::string& token) {
    return token == "class" || token == "struct" || token == "union" || token == "enum";
}

std::string joined(Tokens tokens) {
    std::string text;
    for (const std::string& token : tokens) {
        text += token;
    }
    return text;
}

/// How many tokens from the first one, an opening bracket, to its closing one.
std::size_t bracketed(Tokens tokens, const char* open, const char* close) {
    std::size_t depth = 0;
    for (std::size_t k = 0; k < tokens.size(); ++k) {
        depth += tokens[k] == open ? 1U : 0U;
        depth -= tokens[k] == close ? 1U : 0U;
        if (depth == 0) {
            return k + 1;
        }
    }
    return tokens.size();
}

/// Without `template <...>` and `requires ...`.
Tokens without_template(Tokens declaration) {
    bool is_template = false;
    while (declaration.size() > 1 && declaration[0] == "template" && declaration[1] == "<") {
        declaration = declaration.subspan(1 + bracketed(declaration.subspan(1), "<", ">"));
        is_template = true;
    }
    if (is_template && !declaration.empty() && declaration[0] == "requires") {
        const auto key = std::find_if(declaration.begin(), declaration.end(), is_class_key);
        declaration = declaration.subspan(static_cast<std::size_t>(key - declaration.begin()));
    }
    return declaration;
}

/// Without `[[...]]` and `alignas(...)`.
Tokens without_attributes(Tokens declaration) {
    while (!declaration.empty()) {
        if (declaration[0] == "[") {
            declaration = declaration.subspan(bracketed(declaration, "[", "]"));
        } else if (declaration[0] == "alignas") {
            declaration = declaration.subspan(1 + bracketed(declaration.subspan(1), "(", ")"));
        } else {
            break;
        }
    }
    return declaration;
}

class Finder {
public:
    explicit Finder(Tokens tokens) : tokens_(tokens) {}

    std::vector<TypeDefinition> definitions() {
        std::size_t begin = 0; // of the declaration
        for (std::size_t k = 0; k < tokens_.size(); ++k) {
            const std::string& token = tokens_[k];
            const Tokens declaration = tokens_.subspan(begin, k - begin);
            if (token == "(") {
                k += bracketed(tokens_.subspan(k), "(", ")") - 1;
                continue;
            }
            if (token == "{") {
                k += enter(declaration, tokens_.subspan(k));
            } else if (token == "}") {
                leave();
            } else if (token == ";") {
                note_alias(declaration);
            } else {
                continue;
            }
            begin = k + 1;
        }
        return std::move(found_);
    }

private:
    /// How many tokens of `body`, which begins with a brace, are skipped after that: none in a namespace with a name.
    std::size_t enter(Tokens declaration, Tokens body) {
        const auto key = std::find(declaration.begin(), declaration.end(), "namespace");
        const Tokens name = declaration.last(static_cast<std::size_t>(declaration.end() - key));
        const bool is_linkage = declaration.size() == 2 && declaration[0] == "extern";
        if (name.size() > 1 || is_linkage) {
            namespaces_.push_back(is_linkage ? "" : joined(name.subspan(1)) + "::");
            return 0;
        }
        if (name.empty()) {
            note_class(declaration);
        }
        return bracketed(body, "{", "}") - 1;
    }

    void leave() {
        if (!namespaces_.empty()) {
            namespaces_.pop_back();
        }
    }

    void note_class(Tokens head) {
        head = without_template(head);
        if (head.empty() || !is_class_key(head[0])) {
            return;
        }
        const bool is_scoped_enum = head[0] == "enum" && head.size() > 1 && is_class_key(head[1]);
        const Tokens rest = without_attributes(head.subspan(is_scoped_enum ? 2 : 1));
        const auto end = std::find_if(rest.begin(), rest.end(), [](const std::string& token) {
            return token == ":" || token == "final";
        });
        const Tokens name = rest.first(static_cast<std::size_t>(end - rest.begin()));
        const bool goes_on = name.size() > 1 && name[1] != "::" && name[1] != "<";
        const bool is_function = std::find(name.begin(), name.end(), "(") != name.end();
        if (!name.empty() && !goes_on && !is_function) {
            note(joined(name), "");
        }
    }

    void note_alias(Tokens declaration) {
        declaration = without_template(declaration);
        if (declaration.size() < 3) {
            return;
        }
        if (declaration[0] == "using" && declaration[2] == "=") {
            note(declaration[1], joined(declaration.subspan(3)));
        } else if (declaration[0] == "typedef") {
            note(declaration.back(), joined(declaration.subspan(1, declaration.size() - 2)));
        }
    }

    void note(const std::string& name, const std::string& as) {
        std::string whole;
        for (const std::string& each : namespaces_) {
            whole += each;
        }
        found_.push_back({whole + name, as});
    }

    Tokens tokens_;
    std::vector<std::string> namespaces_;
    std::vector<TypeDefinition> found_;
};

} // namespace

std::vector<TypeDefinition> type_definitions(std::string_view text) {
    const std::vector<std::string> tokens = cpp_tokens(text);
    return Finder(tokens).definitions();
}

void OneDefinition::add(const std::string& file, std::string_view text) {
    for (const TypeDefinition& definition : type_definitions(text)) {
        names_[definition.name][file].insert(definition.as);
    }
}

std::vector<std::string> OneDefinition::violations() const {
    std::vector<std::string> sentences;
    for (const auto& [name, files] : names_) {
        const std::set<std::string>& first = files.begin()->second;
        const bool is_one_alias =
            !first.contains("") &&
            std::all_of(files.begin(), files.end(), [&](const auto& each) { return each.second == first; });
        if (files.size() == 1 || is_one_alias) {
            continue;
        }
        std::string sentence = name + " is defined in";
        for (const auto& [file, definitions] : files) {
            sentence += " " + file;
        }
        sentences.push_back(sentence + "; rename all but one");
    }
    return sentences;
}

} // namespace frustumscreen::tests
