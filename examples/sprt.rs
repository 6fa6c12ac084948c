//! Decides whether a rate of 10 % or of 30 % lies behind a stream of outcomes.
//!
//! Prints where a stream of one success in three stops, and what the test really costs and risks: the exact risk,
//! power and mean sample size at both rates and between them, beside Wald's approximation of the mean.

use steradian::sprt::{Bernoulli, Bounds, Sprt};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);

    let run = test.decide((1..).map(|place| place % 3 == 0));
    println!("one success in three: {:?} after {} observations", run.step(), run.samples());

    println!("rate  accept 10 %  accept 30 %  mean samples  (Wald's)  nine in ten stop by");
    for p in [0.1, 0.2, 0.3] {
        let (exact, wald) = (test.characteristic(p)?, test.wald_approximation(p)?);
        let last = exact.quantile(0.9).ok_or("no quantile")?;
        let (accept, reject, mean, approximate) =
            (exact.accept(), exact.reject(), exact.mean_samples(), wald.mean_samples());
        println!("{p:<4}  {accept:<11.6}  {reject:<11.6}  {mean:<12.4}  {approximate:<8.4}  {last}");
    }
    Ok(())
}
