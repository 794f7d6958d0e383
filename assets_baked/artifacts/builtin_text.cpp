#include "assets_baked/artifacts/builtin.h"

#include <algorithm>
#include <array>

namespace frustumscreen {
namespace {

struct Entry {
    std::string_view name, language;
    BuiltinText text;
};

/// The first entry of a name is its English one.
constexpr std::array<Entry, 10> entries = {{
    {"amphora",
     "en",
     {"Neck-amphora",
      "Warriors stride around the belly of this jar in the manner of Athenian black-figure painters, above a "
      "frieze of deer. It is a modern work, drawn by this exhibit's own program."}},
    {"amphora",
     "de",
     {"Halsamphora",
      "Krieger schreiten um den Bauch dieses Gefäßes, wie sie die schwarzfigurigen Maler Athens malten, über "
      "einem Fries von Hirschen. Es ist ein neues Werk, gezeichnet vom Programm dieser Ausstellung."}},
    {"amphora",
     "fr",
     {"Amphore à col",
      "Des guerriers défilent sur la panse de ce vase, à la manière des peintres athéniens à figures noires, "
      "au-dessus d'une frise de cerfs. C'est une œuvre moderne, dessinée par le programme de l'exposition."}},
    {"amphora",
     "es",
     {"Ánfora de cuello",
      "Unos guerreros recorren la panza de este vaso, a la manera de los pintores atenienses de figuras "
      "negras, "
      "sobre un friso de ciervos. Es una obra moderna, dibujada por el programa de esta exposición."}},
    {"amphora",
     "el",
     {"Αμφορέας με λαιμό",
      "Πολεμιστές βαδίζουν γύρω από την κοιλιά του αγγείου, όπως τους ζωγράφιζαν οι Αθηναίοι μελανόμορφοι "
      "ζωγράφοι, πάνω από μια ζώνη με ελάφια. Είναι σύγχρονο έργο, σχεδιασμένο από το πρόγραμμα της "
      "έκθεσης."}},
    {"nautilus-cup",
     "en",
     {"Nautilus cup", "Goldsmiths of the sixteenth and seventeenth centuries mounted shells from far seas as "
                      "drinking cups for "
                      "princes. This one was grown and gilded by this exhibit's own program."}},
    {"nautilus-cup",
     "de",
     {"Nautiluspokal", "Goldschmiede des 16. und 17. Jahrhunderts fassten Schalen aus fernen Meeren als "
                       "Trinkgefäße für Fürsten. "
                       "Diese hier ließ das Programm dieser Ausstellung wachsen und vergoldete sie."}},
    {"nautilus-cup",
     "fr",
     {"Coupe nautile",
      "Les orfèvres des XVIe et XVIIe siècles montaient en coupes princières des coquilles venues de mers "
      "lointaines. Celle-ci a grandi et fut dorée dans le programme de l'exposition."}},
    {"nautilus-cup",
     "es",
     {"Copa de nautilo",
      "Los orfebres de los siglos XVI y XVII montaban conchas de mares lejanos como copas para príncipes. El "
      "programa de esta exposición hizo crecer esta y la doró."}},
    {"nautilus-cup",
     "el",
     {"Κύπελλο από ναυτίλο", "Οι χρυσοχόοι του 16ου και του 17ου αιώνα έδεναν όστρακα από μακρινές θάλασσες "
                             "σε κύπελλα για ηγεμόνες. "
                             "Αυτό εδώ το μεγάλωσε και το επιχρύσωσε το πρόγραμμα της έκθεσης."}},
}};

} // namespace

BuiltinText builtin_text(std::string_view name, std::string_view language) {
    const auto of_name = [name](const Entry& entry) { return entry.name == name; };
    const auto english = std::find_if(entries.begin(), entries.end(), of_name);
    if (english == entries.end()) {
        return {};
    }
    const auto asked = std::find_if(english, entries.end(), [&](const Entry& entry) {
        return of_name(entry) && entry.language == language;
    });
    return asked == entries.end() ? english->text : asked->text;
}

} // namespace frustumscreen
