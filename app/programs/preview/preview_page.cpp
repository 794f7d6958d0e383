#include "app/programs/preview/preview_page.h"

#include "app/programs/preview/html_parts.h"
#include "app/programs/preview/page_files.h"
#include "app/programs/preview/states_part.h"
#include "app/programs/preview/torch_part.h"
#include "firmware_host/base/words_of_time.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace frustumscreen::programs {

namespace {

constexpr float turn_quality = 82.0F;
/// Between a behaviour's pictures: none is too short to be seen, and an hour's are not waited for.
constexpr double shortest_step_ms = 40.0, longest_step_ms = 1000.0;
constexpr double frame_s = 0.15; ///< as step_ms of page.js
constexpr std::string_view reload_without_scripts =
    "<noscript><meta http-equiv=\"refresh\" content=\"2\"></noscript>\n";

std::string reload_script_part() {
    return fmt::format("<script>{}</script>\n", page_reload_script());
}

/// The rules that depend on the pictures of a behaviour, which have one size and number.
std::string style_of(const std::vector<BehaviourPictures>& behaviours) {
    return behaviours.empty()
               ? std::string()
               : fmt::format(
                     ".scripted .film {{ aspect-ratio: {} / {}; }}\n.scripted .film img {{ width: {}%; }}\n",
                     behaviours.front().size.x, behaviours.front().size.y, 100 * behaviours.front().frames);
}

/// The page's style with the rules that depend on the sheet of pictures.
std::string style_of(const TurnPictures& turn) {
    return fmt::format(
        "{}#turn {{ aspect-ratio: {} / {}; --columns: {}; --rows: {}; --row-s: {:g}s; --turn-s: {:g}s; }}\n"
        "#turn img {{ width: {}%; height: {}%; }}\n"
        "@keyframes across {{ to {{ left: -{}%; }} }}\n@keyframes down {{ to {{ top: -{}%; }} }}\n",
        page_style(), turn.size.x, turn.size.y, turn.columns, turn.rows, frame_s * turn.columns,
        frame_s * turn.frames, 100 * turn.columns, 100 * turn.rows, 100 * turn.columns, 100 * turn.rows);
}

std::string head(const pack::PackDescription& pack, const std::string& style, PageKind kind) {
    const bool reloads = kind == PageKind::Reloading;
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "media-src data:; style-src {}; script-src {}{}; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"referrer\" content=\"no-referrer\">\n<title>{} - preview</title>\n<style>{}</style>\n{}"
        "</head>\n",
        policy_hash(style), policy_hash(page_script()),
        reloads ? " " + policy_hash(page_reload_script()) : std::string(), xml_text(pack.title), style,
        reloads ? reload_without_scripts : std::string_view());
}

/// By hotspot, by picture: [left %, top %, seen].
std::string marks_of(const TurnPictures& turn) {
    std::vector<std::string> hotspots;
    for (const std::vector<MarkPlace>& places : turn.marks) {
        std::vector<std::string> frames;
        for (const MarkPlace& place : places) {
            frames.push_back(
                fmt::format("[{:.1f},{:.1f},{}]", 100.0 * place.x, 100.0 * place.y, place.seen ? 1 : 0));
        }
        hotspots.push_back(fmt::format("[{}]", fmt::join(frames, ",")));
    }
    return fmt::format("[{}]", fmt::join(hotspots, ","));
}

std::string turn_of(const pack::PackDescription& pack, const TurnPictures& turn) {
    std::string marks;
    for (std::size_t k = 0; k < turn.marks.size(); ++k) {
        marks += fmt::format("<span class=\"mark\" hidden>{}</span>", k + 1);
    }
    return fmt::format(
        "<div><div id=\"turn\" data-frames=\"{}\" data-columns=\"{}\" data-marks=\"{}\">"
        "<img alt=\"{}: the artifact inside the prop, as a visitor sees it who turns the prop once around\" "
        "src=\"{}\">{}</div>\n"
        "<div id=\"controls\" hidden><button id=\"play\" type=\"button\">Stop</button>"
        "<input id=\"angle\" type=\"range\" min=\"0\" max=\"{}\" value=\"0\" aria-label=\"turn of the prop\">"
        "<span id=\"degrees\"></span></div></div>\n",
        turn.frames, turn.columns, marks_of(turn), xml_text(pack.title),
        data_address("image/webp", image::encode_lossy_webp(turn.sheet, turn_quality)), marks,
        turn.frames - 1);
}

/// A row of a list of facts; empty if `words` is.
std::string fact(std::string_view name, std::string_view words) {
    return words.empty() ? std::string() : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, xml_text(words));
}

/// The small picture by which visitors choose; empty if the pack has none.
std::string table_picture_of(const image::Image8& picture) {
    return picture.texels.empty()
               ? std::string()
               : fmt::format("<figure class=\"card\"><img alt=\"\" width=\"{}\" height=\"{}\" src=\"{}\">"
                             "<figcaption>as it lies on the table among others</figcaption></figure>\n",
                             picture.width, picture.height,
                             data_address("image/webp", image::encode_webp(picture)));
}

std::string beginning(const pack::PackDescription& pack, const PreviewFacts& facts,
                      const PreviewMedia& media) {
    std::string lines;
    const pack::PackCaption none;
    const pack::PackCaption& first = pack.captions.empty() ? none : pack.captions.front();
    for (const std::string* line : {&first.period, &first.place, &first.maker}) {
        if (!line->empty()) {
            lines += fmt::format("<p lang=\"{}\" dir=\"auto\">{}</p>\n", xml_text(first.language),
                                 xml_text(*line));
        }
    }
    const glm::dvec3 mm = 1000.0 * facts.size_m;
    return fmt::format(
        "<header><div class=\"row\">\n{}<div><h1 lang=\"{}\" dir=\"auto\">{}</h1>\n{}<dl>\n{}{}{}{}{}{}{}{}"
        "</dl>\n{}</div>\n</div></header>\n",
        turn_of(pack, media.turn), xml_text(first.language), xml_text(pack.title), lines,
        fact("credit", first.credit), fact("licence", pack.provenance.licence),
        fact("size", fmt::format("{:.0f} mm wide, {:.0f} deep, {:.0f} high in the usual {}", mm.x, mm.y, mm.z,
                                 pack.prop_kind)),
        fact("stands", facts.stands), fact("languages", fmt::format("{}", fmt::join(pack.languages, ", "))),
        fact("id", pack.id),
        fact("pack", fmt::format("{}, {}", facts.pack_name, bytes_in_words(facts.pack_bytes))),
        fact("light", pack.unlit ? "the colours have it in them (unlit)" : "lit as in a museum"),
        table_picture_of(media.table_picture));
}

std::string notes_of(std::string_view kind, const std::vector<std::string>& sentences, bool plain) {
    std::string items;
    for (const std::string& sentence : sentences) {
        items += fmt::format("<li{}><b>{}</b>: {}</li>\n", plain ? " class=\"plain\"" : "", kind,
                             xml_text(sentence));
    }
    return items;
}

std::string warnings(const PreviewFacts& facts) {
    const std::string items = notes_of("lost", facts.lost, false) + notes_of("silent", facts.silent, false) +
                              notes_of("missing", facts.missing, false) +
                              notes_of("guessed", facts.guessed, true) + notes_of("taken", facts.taken, true);
    const bool well = facts.lost.empty() && facts.silent.empty();
    return fmt::format(
        "<section class=\"notes{}\" aria-label=\"what the bake has to say\">"
        "<p>{}</p>\n{}</section>\n"
        "<p class=\"notes\" id=\"trouble\" hidden>This browser cannot show or play all of this page; "
        "open it in a newer one.</p>\n",
        well ? " well" : "",
        well ? "Nothing of the scan or the texts was lost." : "Not everything is in the pack as you gave it:",
        items.empty() ? "" : "<ul>\n" + items + "</ul>");
}

/// A text as it lies on the table, with `what` as the figure's caption.
std::string figure(const ProjectedText& text, const std::string& what) {
    // All texts have one scale: the widest caption is as wide as its column. A cell of a table has no width of its own.
    constexpr double usual_column_px = 560.0;
    const double share = std::min(1.0, text.size.x / widest_text_px());
    const std::string width =
        what.empty() ? fmt::format("{:.0f}", share * usual_column_px) : fmt::format("{:.1f}%", 100.0 * share);
    const std::string picture =
        text.picture.empty()
            ? "<p class=\"missing\">the bake could not set this text; the kiosk uses its own typeface</p>"
            : fmt::format("<img width=\"{}\" alt=\"\" src=\"{}\">", width,
                          data_address("image/webp", text.picture));
    const std::string said =
        what.empty() ? std::string() : fmt::format("<figcaption>{}</figcaption>", xml_text(what));
    return fmt::format("<figure class=\"projected\">{}{}</figure>\n", picture, said);
}

std::string words_of(const pack::PackCaption& caption) {
    std::string words = fmt::format("<p class=\"title\">{}</p>\n", xml_text(caption.title));
    for (const std::string* line : {&caption.period, &caption.place, &caption.maker, &caption.credit}) {
        words += line->empty() ? std::string() : fmt::format("<p class=\"soft\">{}</p>\n", xml_text(*line));
    }
    words += caption.text.empty() ? std::string() : fmt::format("<p>{}</p>\n", html_lines(caption.text));
    if (!caption.description.empty()) {
        words += fmt::format("<p>{}</p>\n", html_lines(caption.description));
    }
    return words;
}

std::string language_part(const ProjectedLanguage& language) {
    const pack::PackCaption& caption = language.caption;
    const std::size_t last = language.ends_with_attribution ? 1 : 0;
    const std::size_t portions = language.portions.size() - last;
    std::string left =
        figure(language.title, last > 0 ? "title, short text and, if there is room, the attribution"
                                        : "title and short text");
    for (std::size_t k = 0; k < portions; ++k) {
        left += figure(language.portions[k], fmt::format("description, {} of {}", k + 1, portions));
    }
    if (last > 0) {
        left += figure(language.portions.back(), "the attribution, at the end of the narration");
    }
    const std::string sound =
        !language.sound.empty()
            ? fmt::format("<p class=\"soft\">The description, as it is spoken:</p><audio controls "
                          "preload=\"metadata\" "
                          "src=\"{}\"></audio>\n",
                          data_address("audio/ogg", language.sound))
            : fmt::format("<p class=\"soft\">{}</p>\n", caption.description.empty()
                                                            ? "There is no description in this language."
                                                            : "The description is shown, and not spoken.");
    return fmt::format("<section class=\"language\"><h3>{0}</h3>\n<div>{1}</div>\n"
                       "<div><div class=\"words\" lang=\"{0}\" dir=\"auto\">{2}</div>{3}</div></section>\n",
                       xml_text(caption.language), left, words_of(caption), sound);
}

std::string hotspots_part(const pack::PackDescription& pack,
                          const std::vector<ProjectedLanguage>& languages) {
    if (pack.hotspots.empty()) {
        return {};
    }
    std::string rows;
    for (std::size_t k = 0; k < pack.hotspots.size(); ++k) {
        for (const ProjectedLanguage& language : languages) {
            const ProjectedText& label = language.labels[k];
            if (label.text.empty()) {
                continue;
            }
            rows +=
                fmt::format("<tr><td>{}</td><td>{}</td><td class=\"text\" lang=\"{}\" dir=\"auto\">{}</td>"
                            "<td class=\"text\">{}</td></tr>\n",
                            k + 1, xml_text(language.caption.language), xml_text(language.caption.language),
                            xml_text(label.text), figure(label, ""));
        }
    }
    return fmt::format(
        "<h2>Places with a word on each</h2>\n<p class=\"soft\">The numbers stand in the picture above, "
        "while the place looks at the visitor.</p>\n<div class=\"scroll\"><table><tr><th>place</th>"
        "<th>language</th><th class=\"text\">label</th><th class=\"text\">as projected</th></tr>\n"
        "{}</table></div>\n",
        rows);
}

/// When a behaviour begins.
std::string start_of(const world::Behaviour& behaviour) {
    switch (behaviour.trigger) {
    case world::Trigger::Button:
        return "begins by the button for it";
    case world::Trigger::Dwell:
        return "begins when a visitor has looked for a while";
    case world::Trigger::Hotspot:
        return fmt::format("begins when place {} is turned to the visitor", behaviour.hotspot + 1);
    case world::Trigger::Narration:
        return fmt::format("begins {:.1f} s after the description", behaviour.narration_s);
    case world::Trigger::Arrival:
        break;
    }
    return "begins when the artifact has come";
}

std::string behaviour_part(const BehaviourPictures& pictures) {
    const world::Behaviour& behaviour = pictures.behaviour.behaviour;
    std::string told;
    for (const pack::PackLabel& title : pictures.behaviour.titles) {
        told += fmt::format("<br>{0}: <span lang=\"{0}\" dir=\"auto\">{1}</span>", xml_text(title.language),
                            xml_text(title.text));
    }
    return fmt::format(
        "<figure class=\"behaviour\"><div class=\"film\" data-frames=\"{}\" data-step=\"{:.0f}\">"
        "<img alt=\"{}: {} pictures side by side\" src=\"{}\"></div>\n"
        "<figcaption><button type=\"button\" hidden>Play</button> <b>{}</b>, {:.1f} s, {}{}"
        "</figcaption></figure>\n",
        pictures.frames, std::clamp(1000.0 * pictures.step_s, shortest_step_ms, longest_step_ms),
        xml_text(behaviour.name), pictures.frames,
        data_address("image/webp", image::encode_lossy_webp(pictures.sheet, turn_quality)),
        xml_text(behaviour.name), behaviour.seconds, start_of(behaviour), told);
}

std::string behaviours_part(const std::vector<BehaviourPictures>& behaviours) {
    if (behaviours.empty()) {
        return {};
    }
    std::string figures;
    for (const BehaviourPictures& pictures : behaviours) {
        figures += behaviour_part(pictures);
    }
    return fmt::format(
        "<h2>What moves</h2>\n<p class=\"soft\">{} pictures of each, over the time that it takes; "
        "below it, what the visitor is told.</p>\n<div class=\"behaviours\">\n{}</div>\n",
        behaviours.front().frames, figures);
}

std::string levels_part(const pack::PackDescription& pack, const PreviewFacts& facts) {
    std::string rows;
    for (std::size_t k = 0; k < facts.levels.size(); ++k) {
        const PreviewLevel& level = facts.levels[k];
        rows += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td>"
                            "<td>{:.3f}</td><td>{:.1f}</td></tr>\n",
                            k == pack.default_level ? " class=\"usual\"" : "", k, level.triangles,
                            bytes_in_words(level.bytes), level.mean_mm, level.p95_mm, level.largest_mm,
                            level.colour_rmse);
    }
    return fmt::format("<h2>How exact it is</h2>\n<p class=\"soft\">Distances between each level of detail "
                       "and your scan, over what a "
                       "visitor can see, in millimetres on the usual {}; colour in steps of 255. The bold "
                       "level is shown unless the "
                       "machine needs another.</p>\n<div class=\"scroll\"><table "
                       "id=\"levels\"><tr><th>level</th>"
                       "<th>triangles</th><th>size</th><th>mean mm</th><th>95 % mm</th><th>largest "
                       "mm</th><th>colour</th></tr>\n{}"
                       "</table></div>\n",
                       xml_text(pack.prop_kind), rows);
}

std::string source_part(const pack::PackDescription& pack, const PreviewFacts& facts) {
    const pack::PackProvenance& from = pack.provenance;
    return fmt::format(
        "<h2>Where it comes from</h2>\n<dl>\n{}{}{}{}{}{}{}</dl>\n", fact("scan", from.source_name),
        fact("triangles", std::to_string(from.source_triangles)), fact("SHA-256", from.source_sha256),
        fact("author", facts.rights.author), fact("licence", from.licence),
        fact("source", facts.rights.source), fact("baked in", words_of_time(facts.seconds)));
}

} // namespace

std::string preview_page(const pack::PackDescription& pack, const PreviewFacts& facts,
                         const PreviewMedia& media, PageKind kind) {
    std::string texts;
    for (const ProjectedLanguage& language : media.languages) {
        texts += language_part(language);
    }
    std::string page =
        head(pack, style_of(media.turn) + style_of(media.behaviours) + style_of(media.torches), kind) +
        "<body>\n" + beginning(pack, facts, media) + "<main>\n" + warnings(facts) +
        "<h2>Texts on the table</h2>\n<p class=\"soft\">Left as the projector draws them, 30 "
        "cm wide; right the "
        "words for reading.</p>\n" +
        texts + hotspots_part(pack, media.languages) + behaviours_part(media.behaviours) +
        torches_part(media.torches) + states_part(media.states) + levels_part(pack, facts) +
        source_part(pack, facts) + "</main>\n";
    page += fmt::format("<footer>Made by {} from {}. This page needs no network and no other file.</footer>\n"
                        "<script>{}</script>\n",
                        xml_text(facts.program), xml_text(facts.pack_name), page_script());
    page += kind == PageKind::Reloading ? reload_script_part() : "";
    return page + "</body>\n</html>\n";
}

std::string without_reloading(std::string page) {
    for (const std::string& part : {std::string(reload_without_scripts), reload_script_part()}) {
        if (const std::size_t at = page.rfind(part); at != std::string::npos) {
            page.erase(at, part.size());
        }
    }
    return page;
}

} // namespace frustumscreen::programs
