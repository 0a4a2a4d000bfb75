"""What several tests share: references written independently, clients, loops, signals."""
