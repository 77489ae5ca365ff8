"""The motion quantity: kappa(q), its references, the tracking law, and postures that realise a kappa."""
