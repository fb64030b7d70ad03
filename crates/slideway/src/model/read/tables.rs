//! Tables: functions given by values.

use super::super::Value;
use super::super::file::{BeyondName, Entry, TableTable};
use super::super::quantity::Quantity;
use super::super::sections::Sections;
use super::{Origin, Reader, STAND_IN, Source, expression_start};
use crate::expression::{
    Beyond, Entry as TableEntry, Expression, Inferred, Names, Table, Values, is_reserved, parse,
};
use crate::fault::FaultKind;
use crate::interval::Interval;

/// A list of numbers of one dimension.
struct Column {
    entries: Vec<TableEntry>,
    inferred: Inferred,
}

impl Reader<'_> {
    /// Makes the tables known to expressions; one that is faulty stands in as zero everywhere.
    pub(super) fn read_tables(&mut self, sections: &Sections) {
        for entry in &sections.tables {
            self.valid_name("table", &entry.name, &entry.span);
            let taken = sections.parameters.iter().map(|parameter| &parameter.name);
            let taken = taken.chain(sections.coordinates.iter().map(|coordinate| &coordinate.name));
            if taken.into_iter().any(|name| *name == entry.name) && !is_reserved(&entry.name) {
                self.fault(FaultKind::TableSharesName { name: entry.name.clone() }, &entry.span);
            }
            let table = self
                .table(entry)
                .unwrap_or_else(|| Table::new(&entry.name, Vec::new(), [Inferred::Any; 2], Beyond::Hold));
            self.names.table(table);
        }
    }

    fn table(&mut self, entry: &Entry<TableTable>) -> Option<std::sync::Arc<Table>> {
        let TableTable { argument, value, beyond } = entry.contents.as_ref()?;
        let name = &entry.name;
        let (arguments, values) =
            (self.column(name, "argument", argument), self.column(name, "value", value));
        if argument.len() != value.len() || argument.is_empty() {
            let (arguments, values) = (argument.len(), value.len());
            self.fault(FaultKind::TableLengths { name: name.clone(), arguments, values }, &entry.span);
            return None;
        }
        let (arguments, values) = (arguments?, values?);
        let falls = arguments.entries.windows(2).position(|pair| pair[1].value < pair[0].value);
        if let Some(index) = falls {
            let kind = FaultKind::TableFalls { name: name.clone(), row: index + 2 };
            self.fault(kind, &argument[index + 1].span);
            return None;
        }
        let beyond = match beyond {
            Some(BeyondName::Repeat) => Beyond::Repeat,
            Some(BeyondName::Hold) | None => Beyond::Hold,
        };
        let inferred = [arguments.inferred, values.inferred];
        let rows = arguments.entries.into_iter().zip(values.entries).map(|(x, y)| [x, y]).collect();
        Some(Table::new(name, rows, inferred, beyond))
    }

    /// The numbers of one list, if all can be read and have one dimension.
    fn column(&mut self, table: &str, key: &str, list: &[Quantity]) -> Option<Column> {
        let read: Vec<Option<(TableEntry, Inferred)>> =
            list.iter().map(|quantity| self.table_entry(table, key, quantity)).collect();
        let read: Vec<(TableEntry, Inferred)> = read.into_iter().collect::<Option<_>>()?;
        let first = read.first().map_or(Inferred::Any, |(_, inferred)| *inferred);
        for (quantity, (_, inferred)) in list.iter().zip(&read) {
            if let (Inferred::Known(wanted), Inferred::Known(found)) = (first, *inferred)
                && wanted != found
            {
                self.fault(FaultKind::WrongDimension { wanted, found }, &quantity.span);
                return None;
            }
        }
        let known = read.iter().map(|(_, inferred)| *inferred).find(|i| matches!(i, Inferred::Known(_)));
        let inferred = known.unwrap_or(Inferred::Any);
        Some(Column { entries: read.into_iter().map(|(entry, _)| entry).collect(), inferred })
    }

    fn table_entry(&mut self, table: &str, key: &str, quantity: &Quantity) -> Option<(TableEntry, Inferred)> {
        let expression = match &quantity.written {
            Value::Number(value) if value.is_finite() => {
                Expression::decimal(*value, self.text.get(quantity.span.clone()).unwrap_or_default())
            }
            Value::Number(_) => {
                let what = format!("a value of tables.{table}.{key}");
                self.fault(FaultKind::NotFinite { what }, &quantity.span);
                return None;
            }
            Value::Text(text) if self.mended && text == STAND_IN => return None,
            Value::Text(text) => return self.constant_entry(text, quantity),
        };
        self.entry_of(&expression, quantity)
    }

    /// A number with a unit; parameters are not known here.
    fn constant_entry(&mut self, text: &str, quantity: &Quantity) -> Option<(TableEntry, Inferred)> {
        match parse(text, &Names::new()) {
            Ok(expression) if expression.is_constant() => self.entry_of(&expression, quantity),
            Ok(_) => {
                self.fault(FaultKind::TableOfTime, &quantity.span);
                None
            }
            Err(faults) => {
                let origin = self.origin(quantity);
                self.faults.extend(faults.into_iter().map(|fault| origin.fault(fault)));
                None
            }
        }
    }

    fn entry_of(&mut self, expression: &Expression, quantity: &Quantity) -> Option<(TableEntry, Inferred)> {
        let number = Values::of_parameters(&[]);
        let range = Values::<Interval>::of_parameters(&[]);
        let read = expression.dimension(&|_| Inferred::Any).and_then(|inferred| {
            let entry =
                TableEntry { value: expression.evaluate(&number)?, enclosure: expression.evaluate(&range)? };
            Ok((entry, inferred))
        });
        match read {
            Ok(entry) => Some(entry),
            Err(fault) => {
                let origin = self.origin(quantity);
                self.faults.push(origin.fault(fault));
                None
            }
        }
    }

    pub(super) fn origin(&self, quantity: &Quantity) -> Origin {
        Origin {
            source: Source::Model,
            span: quantity.span.clone(),
            expression_start: expression_start(quantity, self.text),
        }
    }
}
