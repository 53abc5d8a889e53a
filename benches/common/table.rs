//! Tables of results: printed, and written as CSV to `build/bench`.

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

/// Where the benchmarks write.
pub fn directory() -> PathBuf {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("build/bench");
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A table that grows row by row.
pub struct Table {
    file: File,
    widths: Vec<usize>,
}

impl Table {
    /// Starts the file `name.csv`.
    pub fn new(name: &str, titles: &[&str]) -> Self {
        let file = File::create(directory().join(format!("{name}.csv"))).unwrap();
        let widths = titles.iter().map(|t| t.chars().count().max(9)).collect();
        let mut table = Table { file, widths };
        println!("\n{name}");
        table.row(&titles.iter().map(ToString::to_string).collect::<Vec<_>>());
        table
    }

    /// Adds a row.
    pub fn row(&mut self, cells: &[String]) {
        assert_eq!(cells.len(), self.widths.len());
        let quoted: Vec<_> = cells.iter().map(|cell| format!("\"{cell}\"")).collect();
        writeln!(self.file, "{}", quoted.join(",")).unwrap();
        let line: Vec<_> = cells
            .iter()
            .zip(&self.widths)
            .map(|(cell, &width)| format!("{cell:>width$}"))
            .collect();
        println!("{}", line.join("  "));
    }
}

/// A row's cells.
#[macro_export]
macro_rules! cells {
    ($($value:expr),* $(,)?) => { &[$($value.to_string()),*] };
}
