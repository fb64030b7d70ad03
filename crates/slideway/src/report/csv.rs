//! The report as CSV: one row for each number, so that any tool can filter it.

use super::{Solution, SolveReport};

impl SolveReport {
    /// The report as CSV with the columns `status`, `solution`, `kind`, `name`, `quantity`, `value`, `unit`.
    ///
    /// `solution` counts from 1; the states of preload gaps are "gap 1", "gap 2", ... A report without
    /// solutions has one row, whose `status` says why.
    pub fn csv(&self) -> String {
        let mut rows = Rows { writer: csv::Writer::from_writer(Vec::new()), status: status_word(self) };
        rows.write(["status", "solution", "kind", "name", "quantity", "value", "unit"]);
        let solutions = self.solutions.iter().enumerate().map(|(i, s)| ((i + 1).to_string(), s));
        let gaps = self.preload_gap_states.iter().enumerate().map(|(i, s)| (format!("gap {}", i + 1), s));
        let all: Vec<_> = solutions.chain(gaps).collect();
        if all.is_empty() {
            let status = rows.status.clone();
            rows.write([status.as_str(), "", "", "", "", "", ""]);
        }
        for (number, solution) in all {
            rows.solution(&number, solution);
        }
        String::from_utf8(rows.writer.into_inner().expect("writing to memory cannot fail"))
            .expect("only text was written")
    }
}

fn status_word(report: &SolveReport) -> String {
    serde_json::to_value(report.status)
        .ok()
        .and_then(|value| value.as_str().map(str::to_owned))
        .unwrap_or_default()
}

struct Rows {
    writer: csv::Writer<Vec<u8>>,
    status: String,
}

impl Rows {
    fn write(&mut self, fields: [&str; 7]) {
        self.writer.write_record(fields).expect("writing to memory cannot fail");
    }

    fn solution(&mut self, number: &str, solution: &Solution) {
        let status = self.status.clone();
        let mut row = |kind: &str, name: &str, quantity: &str, value: f64, unit: &str| {
            self.write([&status, number, kind, name, quantity, &value.to_string(), unit]);
        };
        row("mode", &solution.pattern, "determinant", solution.determinant, "");
        row("mode", &solution.pattern, "residual", solution.residual, "");
        for contact in &solution.contacts {
            row("contact", &contact.name, "side", f64::from(contact.side), "");
            row("contact", &contact.name, "normal_force", contact.normal_force, "N");
            row("contact", &contact.name, "friction_force", contact.friction_force, "N");
            row("contact", &contact.name, "sliding_velocity", contact.sliding_velocity, "m/s");
            if let Some(couple) = contact.couple {
                row("contact", &contact.name, "couple", couple, "N m");
            }
            if let Some(pressure) = contact.pressure {
                row("contact", &contact.name, "pressure", pressure, "Pa");
            }
            if let Some(share) = contact.preload_share {
                row("contact", &contact.name, "preload_share", share, "");
            }
            if let Some(acceleration) = contact.gap_acceleration {
                row("contact", &contact.name, "gap_acceleration", acceleration, "m/s^2");
            }
        }
        for hinge in &solution.hinges {
            row("hinge", &hinge.name, "force_x", hinge.force[0], "N");
            row("hinge", &hinge.name, "force_y", hinge.force[1], "N");
            if let Some(friction) = hinge.friction {
                row("hinge", &hinge.name, "friction_couple", friction.couple, "N m");
            }
        }
        for end in &solution.round_ends {
            row("round_end", &end.name, "normal_force", end.normal_force, "N");
            row("round_end", &end.name, "direction", end.direction, "rad");
            row("round_end", &end.name, "friction_force", end.friction_force, "N");
        }
        for carried in &solution.carried {
            row("joint", &carried.name, carried.quantity.key(), carried.value, carried.unit);
        }
        for body in &solution.bodies {
            row("body", &body.name, "acceleration_x", body.acceleration[0], "m/s^2");
            row("body", &body.name, "acceleration_y", body.acceleration[1], "m/s^2");
            row("body", &body.name, "angular_acceleration", body.angular_acceleration, "rad/s^2");
            if let Some([along_z, about_x, about_y]) = body.out_of_plane {
                row("body", &body.name, "acceleration_z", along_z, "m/s^2");
                row("body", &body.name, "angular_acceleration_x", about_x, "rad/s^2");
                row("body", &body.name, "angular_acceleration_y", about_y, "rad/s^2");
            }
            row("body", &body.name, "residual_force", body.residual_force, "N");
            row("body", &body.name, "residual_moment", body.residual_moment, "N m");
        }
        for coordinate in &solution.coordinates {
            row("coordinate", &coordinate.name, "acceleration", coordinate.acceleration, coordinate.unit);
        }
        for drive in &solution.drives {
            row("drive", &drive.name, "effort", drive.effort, drive.unit);
        }
    }
}
