"""The balance quantity: total rate of angular momentum delta_P, the ZMP it gives, and what physics allows."""
