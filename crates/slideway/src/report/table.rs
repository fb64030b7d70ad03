//! Aligned tables.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Column, ColumnConstraint, ContentArrangement, Table, Width};

/// Rows under a header, indented by two blanks. Columns of numbers are aligned to the right, all others to the left. What
/// is wider than `width` wraps words of its cells; numbers are never broken.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>], width: usize) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(header.iter().map(|title| (*title).to_owned()));
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(narrow(width.saturating_sub(2)));
    for row in rows {
        table.add_row(row.clone());
    }
    for (index, column) in table.column_iter_mut().enumerate() {
        let cells = || rows.iter().filter_map(|row| row.get(index)).map(String::as_str);
        lay_out(column, header.get(index).copied().unwrap_or_default(), cells);
    }
    table.to_string().lines().flat_map(|line| ["  ", line.trim_end(), "\n"]).collect()
}

/// Blanks between columns.
const GAP: u16 = 3;

fn lay_out<'c, C: Iterator<Item = &'c str>>(column: &mut Column, title: &str, cells: impl Fn() -> C) {
    column.set_padding((0, GAP));
    let widest = |text: &str| text.split(' ').map(|word| word.chars().count()).max().unwrap_or(0);
    let of_numbers = are_numbers(cells());
    let least = if of_numbers {
        column.set_cell_alignment(CellAlignment::Right);
        cells().map(|cell| cell.chars().count()).max().unwrap_or(0)
    } else {
        cells().map(widest).max().unwrap_or(0)
    };
    let least = narrow(least.max(widest(title))).saturating_add(GAP);
    column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(least)));
}

fn narrow(width: usize) -> u16 {
    u16::try_from(width).unwrap_or(u16::MAX)
}

/// Whether the cells that are not empty are numbers, for the most part: some may be "infinite" or "any".
fn are_numbers<'c>(cells: impl Iterator<Item = &'c str>) -> bool {
    let (mut numbers, mut words) = (0, 0);
    for cell in cells.filter(|cell| !cell.is_empty()) {
        let digits = cell.trim_start_matches(['-', '(']);
        let is_number = digits.starts_with(|first: char| first.is_ascii_digit());
        *(if is_number { &mut numbers } else { &mut words }) += 1;
    }
    numbers > words
}
