//! Aligned tables.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};

/// Rows under a header, indented by two blanks; the first `words` columns are words (left), the others
/// numbers (right).
pub(crate) fn table(header: &[&str], rows: &[Vec<String>], words: usize) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(header.iter().map(|title| (*title).to_owned()));
    for row in rows {
        table.add_row(row.clone());
    }
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((0, 3));
        if index >= words {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.to_string().lines().flat_map(|line| ["  ", line.trim_end(), "\n"]).collect()
}
