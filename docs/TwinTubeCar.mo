within ;
model TwinTubeCar "The four dampers of a car between body and wheels, around the imported co-simulation FMUs of SA7 and SA8"
  parameter Modelica.Units.SI.Position s_rel0[4] = zeros(4) "Distances of the flanges in the middle positions (stroke 0)";
  parameter Real oil_level[4](each min = 0, each max = 1) = ones(4) "Oil in the dampers, share of the intact volume";
  parameter Real gas_preload[4](each min = 0, each max = 1) = ones(4) "Gas pressures above ambient, share of the nominal";
  parameter Modelica.Units.SI.Temperature T = 296.15 "Temperature of the dampers; at 296.15 K their parameters hold";
  parameter Modelica.Units.SI.Time step = 1e-3 "Communication step of the FMUs";
  Modelica.Mechanics.Translational.Interfaces.Flange_a wheel[4] "Wheel's ends: front left, front right, rear left, rear right";
  Modelica.Mechanics.Translational.Interfaces.Flange_b body[4] "Body's ends, in the same order";
  Modelica.Units.SI.Position s_rel[4] "Distances of the flanges";
  Modelica.Units.SI.Velocity v_rel[4] "Velocities, positive in rebound";
  twintube_SA7_fmu front[2](
    oil_level = oil_level[1:2],
    gas_preload = gas_preload[1:2],
    each fmi_CommunicationStepSize = step) "The front FMUs as the tool imported them";
  twintube_SA8_fmu rear[2](
    oil_level = oil_level[3:4],
    gas_preload = gas_preload[3:4],
    each fmi_CommunicationStepSize = step) "The rear FMUs";
equation
  for i in 1:4 loop
    s_rel[i] = body[i].s - wheel[i].s;
    v_rel[i] = der(s_rel[i]);
    body[i].f + wheel[i].f = 0;
  end for;
  for i in 1:2 loop
    front[i].stroke = s_rel[i] - s_rel0[i];
    front[i].velocity = v_rel[i];
    front[i].temperature = T;
    rear[i].stroke = s_rel[i + 2] - s_rel0[i + 2];
    rear[i].velocity = v_rel[i + 2];
    rear[i].temperature = T;
    // Positive where it pulls the flanges together, as the force of Modelica's Damper is.
    body[i].f = front[i].force;
    body[i + 2].f = rear[i].force;
  end for;
  annotation(Documentation(info = "<html><p>Along the line of each damper; a suspension's leverage belongs between these flanges
and the wheel. The force belongs to the end of the last communication step and is held until the next one ends. The masses at
all flanges have to be there: the element has no inertia.</p></html>"));
end TwinTubeCar;
