// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::skeleton {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Table read(const std::string& name, const std::string& content) {
    const TemporaryFolder folder;
    write_bytes(folder / name, content);
    return read_table(folder / name);
}
std::string refusal(const std::string& name, const std::string& content) {
    try {
        (void)read(name, content);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no refusal";
}

TEST(Table, HeadersOfManyKindsSayTheSame) {
    for (const std::string header :
         {"motion\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\n",
          "motion\r\nversion=1\r\n\r\nnRows = 2\r\nnr=2\r\nnc=3\r\nendheader\r\n",
          "motion\nversion=1\nDataType=double\ndatarows 2\ndatacolumns 3\nENDHEADER\n\n",
          "\xEF\xBB\xBFmotion\nAngles are in radians.\nendheader\n"})
        for (const std::string rows :
             {"time\ta\tb\n0\t1\t2\n0.5\t3\t4\n", "  time  a b \n\n 0 1  2\n0.5 +3\t4e0 \n\n",
              "time\ta\tb\r\n0\t1\t2\r\n0.5\t3\t4"}) {
            const Table table = read("x.mot", header + rows);
            EXPECT_EQ(table.title, "motion");
            EXPECT_FALSE(table.in_degrees) << header;
            EXPECT_THAT(table.columns, ElementsAre("a", "b"));
            EXPECT_THAT(table.times, ElementsAre(0, 0.5));
            EXPECT_THAT(table.rows, ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4)));
        }
    EXPECT_THAT(read("x.csv", "time;a;b\n0;1;2\n").rows, ElementsAre(ElementsAre(1, 2)));
}

TEST(Table, DegreesAreWhatTheHeaderSaysOrAnOldMotionHas) {
    const std::string rows = "endheader\ntime a\n0 1\n";
    EXPECT_TRUE(read("x.sto", "m\nversion=1\ninDegrees=yes\n" + rows).in_degrees);
    EXPECT_TRUE(read("x.sto", "m\nversion=1\ninDegrees = Y\n" + rows).in_degrees);
    EXPECT_TRUE(read("x.mot", "m\nAngles are in degrees.\n" + rows).in_degrees);
    EXPECT_TRUE(read("x.mot", "m\nnRows=1\nnColumns=2\n\n# SIMM\n" + rows).in_degrees);
    EXPECT_FALSE(read("x.mot", "m\nversion=1\n" + rows).in_degrees);
    EXPECT_FALSE(read("x.sto", "m\nnRows=1\n" + rows).in_degrees);
    EXPECT_FALSE(read("x.mot", "m\ninDegrees=no\n" + rows).in_degrees);
    EXPECT_FALSE(read("x.csv", "time,a\n0,1\n").in_degrees);
}

TEST(Table, BrokenOnesAreRefusedWithTheLine) {
    const std::string head = "m\nendheader\ntime a b\n";
    EXPECT_THAT(refusal("x.sto", head + "0 1 2\n1 1 nan\n"),
                AllOf(HasSubstr("x.sto:5: "), HasSubstr("column 'b' holds 'nan'")));
    EXPECT_THAT(refusal("x.sto", head + "0 1 2\n1 1 inf\n"), HasSubstr("finite"));
    EXPECT_THAT(refusal("x.sto", head + "0 1 2\n1 1\n"), HasSubstr("holds 2 numbers"));
    EXPECT_THAT(refusal("x.sto", head + "0 1 2 3\n"), HasSubstr("holds 4 numbers"));
    EXPECT_THAT(refusal("x.sto", head + "0 1 2\n0 1 2\n"),
                AllOf(HasSubstr("x.sto:5: "), HasSubstr("0 follows 0")));
    EXPECT_THAT(refusal("x.sto", head), HasSubstr("no row follows"));
    EXPECT_THAT(refusal("x.sto", "m\nnRows=3\nendheader\ntime a\n0 1\n"), HasSubstr("cut short"));
    EXPECT_THAT(refusal("x.sto", "m\nnColumns=3\nendheader\ntime a\n0 1\n"),
                HasSubstr("3 columns, but 2 are named"));
    EXPECT_THAT(refusal("x.sto", "time a\n0 1\n"), HasSubstr("endheader"));
    EXPECT_THAT(refusal("x.csv", "time,a\n0,0;5\n"), HasSubstr("'0;5'"));
    EXPECT_THAT(refusal("x.xlsx", ""), HasSubstr("'.xlsx' is no table"));
    EXPECT_THROW((void)read_table("/nowhere/x.sto"), IoError);
}

Table small() { return {"it", true, {"/a/b/value", "c"}, {0, 0.1}, {{1.0 / 3, -2}, {1e-300, 4}}}; }

TEST(Table, WhatIsWrittenReadsBackTheSame) {
    const TemporaryFolder folder;
    write_table(small(), "Nm", folder / "x.sto");
    const Table back = read_table(folder / "x.sto");
    EXPECT_EQ(back.title, "it");
    EXPECT_TRUE(back.in_degrees);
    EXPECT_EQ(back.columns, small().columns);
    EXPECT_EQ(back.times, small().times);
    EXPECT_EQ(back.rows, small().rows);
    EXPECT_THAT(read_bytes(folder / "x.sto"),
                HasSubstr("it\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nunits=Nm\nendheader\n"
                          "time\t/a/b/value\tc\n0\t0.3333333333333333\t-2\n"));
}

TEST(Table, WhatCouldNotBeReadBackIsNotWritten) {
    const TemporaryFolder folder;
    const auto why = [&](const Table& table, const std::string& units = "") {
        try {
            write_table(table, units, folder / "x.sto");
        } catch (const InputError& error) {
            EXPECT_FALSE(std::filesystem::exists(folder / "x.sto"));
            return std::string(error.what());
        }
        return std::string("no refusal");
    };
    Table table = small();
    table.rows[1][0] = std::nan("");
    EXPECT_THAT(why(table), HasSubstr("row 2 holds nan"));
    table = small();
    table.times[1] = 0;
    EXPECT_THAT(why(table), HasSubstr("times must ascend"));
    table = small();
    table.rows[0].pop_back();
    EXPECT_THAT(why(table), HasSubstr("row 1 has 1 numbers"));
    table = small();
    table.columns[1] = "two words";
    EXPECT_THAT(why(table), HasSubstr("without blanks"));
    table = small();
    table.title = "a\nb";
    EXPECT_THAT(why(table), HasSubstr("title"));
    EXPECT_THAT(why(small(), "N\nm"), HasSubstr("units"));
    EXPECT_THAT(why({}), HasSubstr("0 rows"));
    EXPECT_THROW(write_table(small(), "", "/nowhere/x.sto"), IoError);
}

TEST(Table, ColumnsAreFoundByNameAndShortName) {
    Table table;
    table.columns = {"/jointset/elbow/flex/value", "/jointset/elbow/flex/speed",
                     "/forceset/BRA/activation", "BIC.activation", "plain"};
    EXPECT_EQ(find_column(table, "flex"), 0);
    EXPECT_EQ(find_column(table, "/jointset/elbow/flex/speed"), 1);
    EXPECT_EQ(find_column(table, "BRA"), 2);
    EXPECT_EQ(find_column(table, "BIC"), 3);
    EXPECT_EQ(find_column(table, "plain"), 4);
    EXPECT_EQ(find_column(table, "elbow"), -1);
    table.columns.push_back("flex");
    EXPECT_THROW((void)find_column(table, "flex"), InputError);
}

// Decimals are points whatever the locale of the program.
TEST(Table, NumbersDoNotDependOnTheLocale) {
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"})
        if (std::setlocale(LC_ALL, locale)) {
            EXPECT_EQ(read("x.csv", "time,a\n0.5,1.25\n").rows[0][0], 1.25);
            break;
        }
    std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace myotet::skeleton
