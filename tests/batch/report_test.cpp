// The report as programs and browsers read it: Python's csv and html.parser read names that need every escape.
#include "app/programs/batch/batch_report.h"
#include "tests/programs/program_folder.h"

namespace frustumscreen::programs {
namespace {

class Report : public ProgramFolder {
protected:
    /// The output of the Python program.
    std::string python(const std::string& program) const {
        put("look.py", program);
        EXPECT_EQ(std::system(fmt::format("cd '{}' && python3 look.py >out.txt", folder.string()).c_str()),
                  0);
        return text("out.txt");
    }
};

const std::vector<BatchRow> rows = [] {
    std::vector<BatchRow> made(3);
    made[0] = {"a, \"b\"\nc", BatchStatus::Baked, 1.25, "", "=Jug & <b>", 2, 1'500'000, 0.5, 1.0, 2.0, 0,
               true};
    made[0].scan = {"G&B", 4622,      2313,  {{8192, 4096}, {8192, 4096}, {16, 16}},
                    3,     true,      false, {0.1, 2.0, 30.25},
                    "cm",  1'200'000, 4000,  1};
    made[1].object = "bad";
    made[1].status = BatchStatus::Failed;
    made[1].sentence = "x: <script>alert(1)</script>, \"no\"";
    made[2] = {"plain", BatchStatus::Unchanged, 3.0, "", "T", 1, 10, 0, 0, 0, 0, false};
    return made;
}();

TEST_F(Report, WritesCsvThatReadsBackUnchanged) {
    put("report.csv", report_csv(rows));
    EXPECT_EQ(
        python(
            "import csv\n"
            "for row in csv.DictReader(open('report.csv', newline='')):\n"
            "    assert None not in row and None not in row.values()\n"
            "    print([row[k] for k in ('object', 'status', 'seconds', 'sentence', 'bytes', 'title')])\n"),
        "['a, \"b\"\\nc', 'baked', '1.2', '', '1500000', '=Jug & <b>']\n"
        "['bad', 'failed', '0.0', 'x: <script>alert(1)</script>, \"no\"', '', '']\n"
        "['plain', 'unchanged', '3.0', '', '10', 'T']\n");
}

TEST_F(Report, HasTheColumnsOfACheck) {
    put("report.csv", report_csv(rows));
    put("report.html", report_page(rows, "C", 1.0, {}));
    std::string keys;
    std::string headings;
    for (const ScanColumn& column : scan_columns()) {
        keys += fmt::format("{} ", column.key);
        headings += fmt::format("{}|", column.heading);
    }
    EXPECT_EQ(python("import csv\n"
                     "rows = list(csv.DictReader(open('report.csv', newline='')))\n"
                     "keys = list(rows[0])\n"
                     "print(' '.join(keys[keys.index('title') + 1:]), '')\n"
                     "print([rows[0][k] for k in ('format', 'triangles', 'pictures', 'colours', 'normals', "
                     "'extents', 'unit', 'estimated_bytes', 'lost')])\n"
                     "print([rows[1][k] for k in ('format', 'triangles', 'lost')])\n"
                     "from html.parser import HTMLParser\n"
                     "class Look(HTMLParser):\n"
                     "    tag = ''; cells = {'th': [], 'td': []}\n"
                     "    def handle_starttag(self, tag, attributes):\n"
                     "        self.tag = tag\n"
                     "        if tag in self.cells: self.cells[tag].append('')\n"
                     "    def handle_data(self, data):\n"
                     "        if self.tag in self.cells: self.cells[self.tag][-1] += data.strip()\n"
                     "look = Look(); look.feed(open('report.html').read())\n"
                     "th, td = look.cells['th'], look.cells['td']\n"
                     "assert len(td) == 3 * len(th), (len(td), len(th))\n"
                     "print('|'.join(th[th.index('silent') + 1:-1]) + '|')\n"
                     "print(td[len(th):][th.index('pictures')], td[len(th):][th.index('format')])\n"),
              keys +
                  "\n['G&B', '4622', '8192x4096 8192x4096 16x16', 'yes', 'no', '0.1 2 30.25', 'cm', "
                  "'1200000', '1']\n"
                  "['', '', '']\n" +
                  headings + "\n2 of 8192x4096, 16x16 G&B\n");
}

TEST_F(Report, EscapesEveryTextInThePage) {
    const std::vector<std::string> over{"old <stuff>"};
    put("report.html", report_page(rows, "Coll & <i>", 61.0, over));
    EXPECT_EQ(python("from html.parser import HTMLParser\n"
                     "class Look(HTMLParser):\n"
                     "    def handle_starttag(self, tag, attributes):\n"
                     "        assert tag not in ('script', 'b', 'i', 'stuff', 'img', 'link'), tag\n"
                     "        for name, value in attributes:\n"
                     "            if name == 'href': print('href', value)\n"
                     "    def handle_data(self, data):\n"
                     "        if any(c in data for c in '<&') and '{' not in data: print(data.strip())\n"
                     "Look().feed(open('report.html').read())\n"),
              "Coll & <i>\nColl & <i>\nSkipped folders without an artifact.toml: old <stuff>\n"
              "x: <script>alert(1)</script>, \"no\"\nhref ./a%2C%20%22b%22%0Ac.html\nG&B\n=Jug & <b>\n")
        << "what failed comes first";
}

TEST(Summary, CountsObjectsByStatus) {
    EXPECT_EQ(summary(rows), "3 objects: 1 baked, 1 unchanged, 1 failed");
    EXPECT_EQ(summary(std::span(rows).first(1)), "1 object: 1 baked");
}

} // namespace
} // namespace frustumscreen::programs
