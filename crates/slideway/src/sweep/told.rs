//! Rows of a point from the report of a careful search.

use super::plan::{Plan, Point};
use super::rows::{PointStatus, RowHead, RowKind, Rows};
use super::writer::{head, number_in_modes};
use crate::report::{
    CertificateKind, Continuum, DrivenMotion, Hinge, OnFace, Solution, SolveReport, Status, Verdict,
};

/// Adds the rows of a point: solutions, gap states, corners of continua, undecided modes.
pub(super) fn write(report: &SolveReport, plan: &Plan, point: Point<'_>, rows: &mut Rows) {
    let first = rows.len();
    let status = match report.status {
        Status::None => PointStatus::None,
        Status::One => PointStatus::One,
        Status::Several => PointStatus::Several,
        Status::Continuum => PointStatus::Continuum,
        Status::PreloadGap => PointStatus::PreloadGap,
        Status::Unknown => PointStatus::Unknown,
    };
    let mut telling = Telling { plan, point, status, rows };
    for solution in &report.solutions {
        let inside = !solution.on_boundary
            && !matches!(solution.certificate, CertificateKind::OnBoundary)
            && solution.determinant != 0.0;
        telling.state(
            solution,
            match inside {
                _ if solution.rests => RowKind::Rest,
                true => RowKind::Solution,
                false => RowKind::Boundary,
            },
        );
    }
    for state in &report.preload_gap_states {
        telling.state(state, RowKind::PreloadGap);
    }
    for continuum in &report.continua {
        telling.corners(continuum);
    }
    for mode in &report.undecided_modes {
        telling.corner(RowKind::Undecided, &mode.pattern, &[], None);
    }
    if rows.len() == first {
        rows.push_empty(head(point, status), point.values);
    }
    number_in_modes(plan, first, rows);
    let count = |text: &str| text.parse().unwrap_or(u32::MAX);
    for head in &mut rows.heads[first..] {
        head.solutions = count(&report.count);
        head.gap_states = count(&report.gap_state_count);
        head.rejected = u32::try_from(report.rejected.len()).unwrap_or(u32::MAX);
    }
}

struct Telling<'t> {
    plan: &'t Plan,
    point: Point<'t>,
    status: PointStatus,
    rows: &'t mut Rows,
}

impl Telling<'_> {
    fn state(&mut self, state: &Solution, kind: RowKind) {
        let columns = &self.plan.columns;
        let numbers = &mut self.rows.numbers;
        numbers.extend_from_slice(self.point.values);
        numbers.extend(state.contacts.iter().map(|contact| contact.normal_force));
        numbers.extend(state.contacts.iter().map(|contact| contact.friction_force));
        let share = |&k: &usize| state.contacts[k].preload_share.unwrap_or(f64::NAN);
        numbers.extend(columns.shares.iter().map(share));
        let couples = columns.couples.iter().filter_map(|couple| state.contacts[couple.contact].couple);
        numbers.extend(couples);
        numbers.extend(state.coordinates.iter().map(|coordinate| coordinate.acceleration));
        numbers.extend(state.drives.iter().map(|drive| drive.effort));
        let may_open = self.plan.mechanism.one_sided().map(|contact| &state.contacts[contact.index()]);
        numbers.extend(may_open.map(|contact| contact.gap_acceleration.unwrap_or(0.0)));
        let names = &self.plan.mechanism.joints;
        let rough =
            |hinge: &Hinge| columns.hinges.iter().any(|one| names[one.joint.index()].name[..] == hinge.name);
        for hinge in state.hinges.iter().filter(|hinge| rough(hinge)) {
            numbers.extend(hinge.force);
            numbers.push(hinge.friction.as_ref().map_or(0.0, |friction| friction.couple));
        }
        if columns.all {
            for body in &state.bodies {
                numbers.extend([body.acceleration[0], body.acceleration[1], body.angular_acceleration]);
            }
            numbers.extend(state.hinges.iter().filter(|hinge| !rough(hinge)).flat_map(|hinge| hinge.force));
        }
        self.finish(
            &state.pattern,
            RowHead {
                kind,
                tips: state.joints.iter().any(|joint| joint.face == Some(OnFace::Tips)),
                negative_determinant: matches!(kind, RowKind::Solution | RowKind::PreloadGap | RowKind::Rest)
                    .then_some(state.determinant < 0.0),
                verdict: if self.plan.attainability {
                    state.attainability.verdict
                } else {
                    Verdict::NotComputed
                },
                ..head(self.point, self.status)
            },
        );
    }

    /// One row for each corner; one without numbers if they are not known.
    fn corners(&mut self, continuum: &Continuum) {
        let kind = if continuum.rests { RowKind::RestRange } else { RowKind::Continuum };
        if continuum.vertices.is_empty() {
            self.corner(kind, &continuum.pattern, &[], None);
        }
        for (index, corner) in continuum.vertices.iter().enumerate() {
            let first = self.rows.numbers.len();
            self.corner(kind, &continuum.pattern, corner, continuum.motion.get(index));
            let columns = &self.plan.columns;
            for held in &continuum.held {
                let contacts = self.plan.mechanism.contacts.iter();
                if let Some(contact) =
                    contacts.map(|contact| &*contact.name).position(|name| name == held.name)
                {
                    self.rows.numbers[first + columns.varied + columns.contacts + contact] = held.at[index];
                }
            }
        }
    }

    /// A row with normal forces, and with accelerations and efforts, as far as they are known.
    fn corner(&mut self, kind: RowKind, pattern: &str, normal_forces: &[f64], motion: Option<&DrivenMotion>) {
        let columns = &self.plan.columns;
        let before = columns.varied + 2 * columns.contacts + columns.shares.len() + columns.couples.len();
        let rows = &mut *self.rows;
        let start = rows.numbers.len();
        rows.numbers.extend_from_slice(self.point.values);
        rows.numbers.extend_from_slice(normal_forces);
        if let Some(motion) = motion {
            rows.numbers.resize(start + before, f64::NAN);
            rows.numbers.extend(motion.accelerations.iter().chain(&motion.efforts));
        }
        self.finish(pattern, RowHead { kind, ..head(self.point, self.status) });
    }

    fn finish(&mut self, pattern: &str, head: RowHead) {
        let rows = &mut *self.rows;
        rows.heads.push(head);
        rows.numbers.resize(rows.heads.len() * rows.width, f64::NAN);
        rows.patterns.extend_from_slice(pattern.as_bytes());
        rows.patterns.resize(rows.heads.len() * rows.contacts, b' ');
    }
}
