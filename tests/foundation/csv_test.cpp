// SPDX-License-Identifier: Apache-2.0
#include "core/csv.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using testing::message_of;

TEST(Csv, FindsColumnsByNameAndFillsOptionalOnes) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("t.csv", "# note\nb,a\r\n 2 ,x\r\n\n-1.5e3,y\n");
  std::vector<double> numbers;
  std::string names;
  read_csv(file, {"a", "b"}, {"c"}, [&](const CsvRow& row) {
    names += row.text(0);
    numbers.push_back(row.number(1));
    EXPECT_EQ(row.text(2), "");
  });
  EXPECT_EQ(names, "xy");
  EXPECT_EQ(numbers, (std::vector<double>{2, -1500}));
}

TEST(Csv, SaysWhichFileLineAndColumnIsWrong) {
  const testing::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    read_csv(folder.write("t.csv", text), {"a", "n"}, {},
             [](const CsvRow& row) { row.integer(1, 0, 9); });
  };
  const auto message = [&](const std::string& text) {
    return message_of<InputError>([&] { read(text); });
  };
  const std::string file = (folder.path() / "t.csv").string();
  EXPECT_EQ(message("a,n\nx,1\nx,one\n"), file + ":3: n \"one\" is not a whole number");
  EXPECT_EQ(message("a,n\nx,10\n"), file + ":2: n \"10\" is not in [0, 9]");
  EXPECT_EQ(message("a,n\nx\n"), file + ":2: has 1 fields; the header names 2");
  EXPECT_EQ(message("a,b\n"), file + ":1: column \"n\" is missing");
  EXPECT_EQ(message("a,n,z\n"), file + ":1: unknown column \"z\"; known are a,n");
  EXPECT_EQ(message("a,n,a\n"),
            file + ":1: column 3 is called \"a\"; every column has a name of its own");
  EXPECT_EQ(message("\xef\xbb\xbf"
                    "a,n\nx,10\n"),
            file + ":2: n \"10\" is not in [0, 9]");
  EXPECT_EQ(message(""), file + ": is empty; the header line a,n is expected");
  EXPECT_EQ(message("# a,n"), file + ": is empty; the header line a,n is expected");
}

TEST(Csv, ReadsColumnsAsSpreadsheetsSaveThem) {
  const testing::TemporaryFolder folder;
  for (const char* text :
       {"# by hand\n\"a\",b\n\"x, y\",2\n", "a;b\n\n# one\nx, y;2\n", "a\tb\r\nx, y\t 2\r\n#"}) {
    std::string names;
    double sum = 0;
    read_csv(folder.write("t.csv", text), {"a", "b"}, {}, [&](const CsvRow& row) {
      names += row.text(0);
      sum += row.number(1);
    });
    EXPECT_EQ(names, "x, y") << text;
    EXPECT_EQ(sum, 2) << text;
  }
}

TEST(Csv, RefusesNumbersThatAreNotFinite) {
  const testing::TemporaryFolder folder;
  for (const char* field : {"nan", "inf", "", "1x"}) {
    const auto file = folder.write("t.csv", std::string("a,b\n1,") + field + "\n");
    EXPECT_THROW(read_csv(file, {"a", "b"}, {}, [](const CsvRow& row) { row.number(1); }),
                 InputError)
        << field;
  }
}

TEST(FormatNumber, ReadsBackTheSame) {
  for (const double value : {0.1, -1.0 / 3, 1e-300, 123456789.123456789}) {
    EXPECT_EQ(std::stod(format_number(value)), value);
  }
  EXPECT_EQ(format_number(std::nan("")), "nan");
}

TEST(CsvTable, ReadsWhatSpreadsheetsSave) {
  const testing::TemporaryFolder folder;
  const auto table = [&](const std::string& text) {
    return read_csv_table(folder.write("t.csv", text));
  };
  const CsvTable quoted =
      table("\xef\xbb\xbfrow, plot_id ,note\r\n1,0101,\"Rock, \"\"early\"\"\nline\"\r\n\n2,,x\n");
  EXPECT_EQ(quoted.columns, (std::vector<std::string>{"row", "plot_id", "note"}));
  ASSERT_EQ(quoted.lines.size(), 2u);
  EXPECT_EQ(quoted.lines[0].fields,
            (std::vector<std::string>{"1", "0101", "Rock, \"early\"\nline"}));
  EXPECT_EQ(quoted.lines[1].fields, (std::vector<std::string>{"2", "", "x"}));
  EXPECT_EQ(quoted.lines[1].line, 5u);
  EXPECT_EQ(table("a;b\n1,5;2\n").lines.at(0).fields, (std::vector<std::string>{"1,5", "2"}));
  EXPECT_EQ(table("\r\n \na;b\n1;2\n").columns, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table("a\tb\n1\t2").lines.at(0).fields, (std::vector<std::string>{"1", "2"}));
}

// As spreadsheets write numbers where commas are decimal signs.
TEST(Csv, CommasAreDecimalSignsWhereOthersSeparateFields) {
  const testing::TemporaryFolder folder;
  const auto number = [&](const std::string& text) {
    double read = 0;
    read_csv(folder.write("t.csv", text), {"a", "b"}, {},
             [&](const CsvRow& row) { read = row.number(1); });
    return read;
  };
  const auto refusal = [&](const std::string& text) {
    return message_of<InputError>([&] { number(text); });
  };
  EXPECT_EQ(number("a;b\n1;71,5\n"), 71.5);
  EXPECT_EQ(number("a;b\n1;\"-0,713\"\n"), -0.713);
  EXPECT_EQ(number("a\tb\n1\t71,5\n"), 71.5);
  EXPECT_EQ(number("a;b\n1;71.5\n"), 71.5);
  for (const char* text : {"1.234,5", "1,234.5", "1,2,3"})
    EXPECT_THAT(refusal(std::string("a;b\n1;") + text), ::testing::HasSubstr("is not a number"));
  EXPECT_THAT(refusal("a,b\n1,\"71,5\"\n"),
              ::testing::HasSubstr("b \"71,5\" is not a number: decimals have a point where"));
  EXPECT_THAT(refusal("a,b\n1,71,5\n"),
              ::testing::HasSubstr("names 2; where decimals have commas, separate fields by"));
}

TEST(CsvTable, ReadsItsOwnFields) {
  const testing::TemporaryFolder folder;
  const std::string text = "a \"b\", c\nd";
  const CsvTable table = read_csv_table(
      folder.write("t.csv", "x,y\n" + csv_field(text) + "," + csv_field("plain") + "\n"));
  EXPECT_EQ(table.lines.at(0).fields, (std::vector<std::string>{text, "plain"}));
}

TEST(CsvTable, SaysWhatIsWrong) {
  const testing::TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& says) {
    const auto message =
        message_of<InputError>([&] { read_csv_table(folder.write("t.csv", text)); });
    EXPECT_NE(message.find(says), std::string::npos) << message;
  };
  refused("", "is empty");
  refused("a,a\n", "column 2 is called \"a\"");
  refused("a,\n1,2\n", "column 2 is called \"\"");
  refused("a,b\n1,2\n1\n", ":3: has 1 fields; the header names 2");
  refused("a,b\n1,\"2\n3,4\n5,6\n", ":2: a quote is opened and not closed");
  refused("a,b\n\"A\"12,2\n", ":2: there is text behind the closing quote of \"A\"");
}

}  // namespace
}  // namespace plotscan
