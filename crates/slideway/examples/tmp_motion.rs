use slideway::model::*;
use slideway::motion::*;
use std::time::Instant;
fn main() {
    let text = slideway::gallery::find("klepp-2002").unwrap().text;
    let text = text.replace("components = [\"P\", 0]", "components = [\"30 N * sin(62.8/s * t)\", 0]");
    let settings = Settings::default()
        .parameter("F_20", "0")
        .parameter("mu_1", "0.3")
        .parameter("k", "20 N/m")
        .parameter("c", "0.5 N s/m");
    let model = Model::parse(&text).unwrap().with(&settings).unwrap();
    let until: f64 = std::env::args().nth(1).map_or(1.0, |a| a.parse().unwrap());
    let start = Instant::now();
    let history = simulate(&model, &SimulateOptions::new(until));
    let took = start.elapsed();
    let history = match history {
        Ok(h) => h,
        Err(f) => {
            println!("{f}");
            return;
        }
    };
    println!(
        "{:?} {:?} events {} {:?} drift {:?} energy {} of {}",
        took,
        history.end,
        history.events.len(),
        history.statistics,
        history.drift,
        history.energy_error,
        history.energy_scale
    );
    for e in history.events.iter().take(30) {
        println!("{} {:?} [{}]", e.words, e.causes, e.alternatives.len());
    }
}
