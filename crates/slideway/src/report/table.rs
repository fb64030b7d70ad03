//! Aligned tables.

use super::wrap::wrapped;

/// Blanks between columns.
const GAP: usize = 3;

/// Rows under a header, indented by two blanks. Columns of numbers are aligned to the right, all others to the left;
/// columns without any text in their rows are left out. What is wider than `width` wraps words of its cells; numbers
/// are never broken.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>], width: usize) -> String {
    let column = |(index, title): (usize, &&str)| {
        let cells: Vec<&str> = rows.iter().map(|row| row.get(index).map_or("", String::as_str)).collect();
        (rows.is_empty() || cells.iter().any(|cell| !cell.is_empty())).then(|| Column::new(title, &cells))
    };
    let mut columns: Vec<Column> = header.iter().enumerate().filter_map(column).collect();
    fit(&mut columns, width.saturating_sub(2));
    (0..=rows.len()).flat_map(|row| lines(&columns, row)).collect()
}

/// A column: its header and its cells, and how wide it is.
struct Column {
    /// The header, then the cells.
    cells: Vec<String>,
    is_numeric: bool,
    width: usize,
}

impl Column {
    /// A column as wide as its widest cell.
    fn new(title: &str, cells: &[&str]) -> Self {
        let cells: Vec<String> =
            std::iter::once(bound_unit(title)).chain(cells.iter().map(|cell| (*cell).to_owned())).collect();
        let is_numeric = are_numbers(cells.iter().skip(1));
        let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
        Self { cells, is_numeric, width }
    }

    /// The lines of a cell where the column has this width.
    fn lines(&self, row: usize, width: usize) -> Vec<String> {
        let cell = &self.cells[row];
        if self.is_numeric && row > 0 { vec![cell.clone()] } else { wrapped(cell, "", width) }
    }

    /// The next smaller width at which it can be set, and the lines of each of its cells then; none if a word or number
    /// would have to be broken.
    fn narrower(&self) -> Option<(usize, Vec<usize>)> {
        let limit = self.width.checked_sub(1)?;
        let cells: Vec<Vec<String>> = (0..self.cells.len()).map(|row| self.lines(row, limit)).collect();
        let width = cells.iter().flatten().map(|line| line.chars().count()).max().unwrap_or(0);
        (width <= limit).then(|| (width, cells.iter().map(Vec::len).collect()))
    }
}

/// Narrows columns until they fit into the width or cannot be narrowed: each time the one that adds the fewest lines to
/// the table, and of several the widest.
fn fit(columns: &mut [Column], available: usize) {
    let rows = columns.first().map_or(0, |column| column.cells.len());
    let mut heights: Vec<Vec<usize>> = columns.iter().map(|_| vec![1; rows]).collect();
    let total = |columns: &[Column]| columns.iter().map(|column| column.width + GAP).sum::<usize>();
    while total(columns) > available + GAP {
        let height = |row: usize, index: usize, of_index: usize| {
            let others = heights.iter().enumerate().filter(|(other, _)| *other != index);
            others.map(|(_, of_rows)| of_rows[row]).fold(of_index, usize::max)
        };
        let choice = columns.iter().enumerate().filter_map(|(index, column)| {
            let (width, lines) = column.narrower()?;
            let all: usize = lines.iter().enumerate().map(|(row, count)| height(row, index, *count)).sum();
            Some((all, std::cmp::Reverse(column.width), index, width, lines))
        });
        let Some((_, _, index, width, lines)) = choice.min() else { return };
        columns[index].width = width;
        heights[index] = lines;
    }
}

/// The lines of a row; those of the header stand at its foot.
fn lines(columns: &[Column], row: usize) -> Vec<String> {
    let cells: Vec<Vec<String>> = columns.iter().map(|column| column.lines(row, column.width)).collect();
    let height = cells.iter().map(Vec::len).max().unwrap_or(0);
    let line = |index: usize| {
        let mut line = " ".repeat(2);
        for (column, cell) in columns.iter().zip(&cells) {
            let above = if row == 0 { height - cell.len() } else { 0 };
            let text = index.checked_sub(above).and_then(|index| cell.get(index)).map_or("", String::as_str);
            let blanks = " ".repeat(column.width.saturating_sub(text.chars().count()));
            let [before, after] = if column.is_numeric { [&*blanks, ""] } else { ["", &blanks] };
            line.extend([before, text, after, &" ".repeat(GAP)]);
        }
        line.replace(NO_BREAK, " ").trim_end().to_owned() + "\n"
    };
    (0..height).map(line).collect()
}

/// A blank at which no line is broken.
const NO_BREAK: char = '\u{a0}';

/// A header whose unit stays in one line: "normal force in N".
fn bound_unit(title: &str) -> String {
    match title.rfind(" in ") {
        Some(at) => format!("{} {}", &title[..at], title[at + 1..].replace(' ', &NO_BREAK.to_string())),
        None => title.to_owned(),
    }
}

/// True if the cells that are not empty are numbers, for the most part: some may be "infinite" or "any".
fn are_numbers<'c>(cells: impl Iterator<Item = &'c String>) -> bool {
    let (mut numbers, mut words) = (0, 0);
    for cell in cells.filter(|cell| !cell.is_empty()) {
        let digits = cell.trim_start_matches(['-', '(']);
        let is_number = digits.starts_with(|first: char| first.is_ascii_digit());
        *(if is_number { &mut numbers } else { &mut words }) += 1;
    }
    numbers > words
}

#[cfg(test)]
mod tests {
    use super::table;

    fn rows(rows: &[&[&str]]) -> Vec<Vec<String>> {
        rows.iter().map(|row| row.iter().map(|cell| (*cell).to_owned()).collect()).collect()
    }

    #[test]
    fn columns_without_text_are_left_out() {
        let text = table(&["a", "b", "c"], &rows(&[&["x", "", "1"], &["y", "", "-20"]]), 80);
        assert_eq!(text, "  a     c\n  x     1\n  y   -20\n");
    }

    /// One line more for the header is better than one more for each row.
    #[test]
    fn what_adds_the_fewest_lines_wraps_first() {
        let rows = rows(&[&["one two", "1"], &["two one", "2"]]);
        let text = table(&["what", "friction in N m"], &rows, 24);
        assert_eq!(
            text,
            "            friction\n  what        in N m\n  one two          1\n  two one          2\n"
        );
    }

    #[test]
    fn words_and_numbers_are_not_broken_though_the_table_is_too_wide() {
        let text = table(&["a", "b"], &rows(&[&["indivisible", "123456 to 7"]]), 10);
        assert_eq!(text, "  a                       b\n  indivisible   123456 to 7\n");
    }
}
